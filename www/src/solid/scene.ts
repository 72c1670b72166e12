import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Spherical,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Lamp, Look } from "../relight/shading.js";
import { towards } from "../vector.js";
import type { HeightField } from "./height_field.js";

/** The angle that an arrow key turns the surface by. */
const TURN = Math.PI / 24;

/** Where the camera is at first: before the surface, far enough for all of it. */
const BEFORE = new Vector3(0, 0, 4.4);

/** The surface in space, seen by a camera that goes around it. It is drawn when something changes. */
export class SolidScene {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new PerspectiveCamera(30, 1, 0.05, 50);
  readonly #controls: OrbitControls;
  readonly #material = new MeshStandardMaterial({ vertexColors: true, side: DoubleSide, roughness: 0.7 });
  readonly #geometry = new BufferGeometry();
  readonly #mesh: Mesh;
  readonly #resized: ResizeObserver;
  #lights: DirectionalLight[] = [];
  #waiting = false;

  /** @throws Error where the browser has no WebGL2 */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    field: HeightField,
  ) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setPixelRatio(devicePixelRatio);
    this.#geometry.setAttribute("position", new BufferAttribute(field.positions, 3));
    this.#geometry.setAttribute("normal", new BufferAttribute(field.normals, 3));
    this.#geometry.setAttribute("color", new BufferAttribute(field.colours, 3));
    this.#geometry.setIndex(new BufferAttribute(field.triangles, 1));
    this.#mesh = new Mesh(this.#geometry, this.#material);
    this.#scene.add(this.#mesh, new AmbientLight(0xffffff, 0.12));
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.minDistance = 0.6;
    this.#controls.maxDistance = 16;
    this.#controls.addEventListener("change", this.#refresh);
    canvas.addEventListener("keydown", this.#key);
    this.#resized = new ResizeObserver(() => this.#resize());
    this.#resized.observe(canvas);
    this.reset();
  }

  /** The camera goes back to where it was at first, a little to the side, so that depth is seen. */
  reset(): void {
    this.#controls.target.set(0, 0, 0);
    this.#camera.position.copy(BEFORE);
    this.#turn(0.45, 0.25);
  }

  /** Other lamps, or another surface. */
  light(lamps: readonly Lamp[], { specular, gloss, coloured, detail, flipped }: Look): void {
    this.#scene.remove(...this.#lights);
    this.#lights = lamps.map(({ x, y, brightness }) => {
      // By pi: a lamp of brightness 1 shows a white surface that faces it as white.
      const light = new DirectionalLight(0xffffff, Math.PI * brightness);
      light.position.set(...towards(x, y));
      return light;
    });
    if (this.#lights.length > 0) this.#scene.add(...this.#lights);
    // A deeper surface has slopes that are as many times as steep, and its normals follow.
    this.#mesh.scale.z = (flipped ? -1 : 1) * Math.max(detail, 0.01);
    this.#material.roughness = specular < 0.01 ? 1 : 1 - 0.75 * gloss;
    this.#material.vertexColors = coloured;
    this.#material.needsUpdate = true;
    this.#refresh();
  }

  /** Gives back what it holds. */
  close(): void {
    this.#resized.disconnect();
    this.canvas.removeEventListener("keydown", this.#key);
    this.#controls.dispose();
    this.#geometry.dispose();
    this.#material.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }

  readonly #refresh = () => {
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      this.#renderer.render(this.#scene, this.#camera);
    });
  };

  readonly #key = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const done = {
      ArrowLeft: () => this.#turn(-TURN, 0),
      ArrowRight: () => this.#turn(TURN, 0),
      ArrowUp: () => this.#turn(0, TURN),
      ArrowDown: () => this.#turn(0, -TURN),
      "+": () => this.#closer(1 / 1.2),
      "=": () => this.#closer(1 / 1.2),
      "-": () => this.#closer(1.2),
      "0": () => this.reset(),
    }[event.key];
    if (!done) return;
    event.preventDefault();
    done();
  };

  /** The camera goes around the surface. */
  #turn(around: number, up: number): void {
    const { target } = this.#controls;
    const place = new Spherical().setFromVector3(this.#camera.position.clone().sub(target));
    place.theta += around;
    place.phi = Math.min(Math.max(place.phi - up, 0.05), Math.PI - 0.05);
    this.#camera.position.setFromSpherical(place).add(target);
    this.#moved();
  }

  #closer(factor: number): void {
    const { target } = this.#controls;
    this.#camera.position.sub(target).multiplyScalar(factor).add(target);
    this.#moved();
  }

  #moved(): void {
    this.#controls.update();
    this.#refresh();
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#camera.aspect = clientWidth / clientHeight;
    // On a narrow canvas as wide as otherwise high.
    this.#camera.zoom = Math.min(1, this.#camera.aspect);
    this.#camera.updateProjectionMatrix();
    this.#renderer.setSize(clientWidth, clientHeight, false);
    // At once: a canvas of a new size is empty until it is drawn.
    this.#renderer.render(this.#scene, this.#camera);
  }
}
