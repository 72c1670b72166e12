// The script of the file that is handed on: put into the page as it is, so it imports nothing.
(() => {
  const get = (id) => document.getElementById(id);
  const data = JSON.parse(get("data").textContent);
  const { width, height, look } = data;
  const lamps = data.lamps.map((lamp) => ({ ...lamp }));
  const canvas = get("object");
  [canvas.width, canvas.height] = [width, height];
  let paint = () => {};
  let waiting = false;

  /** Paints soon, once for however many moves. */
  function refresh() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      paint();
    });
  }

  /** The first lamp goes to the direction with this x and y, clear of the horizon. */
  function shineFrom(x, y) {
    const scale = Math.min(1, 0.92 / Math.max(Math.hypot(x, y), 1e-6));
    lamps[0] = { brightness: 1, ...lamps[0], x: x * scale, y: y * scale };
    refresh();
  }

  function follow(event) {
    const { left, top, width: wide, height: high } = canvas.getBoundingClientRect();
    const radius = Math.min(wide, high) / 2;
    shineFrom((event.clientX - left - wide / 2) / radius, (top + high / 2 - event.clientY) / radius);
  }

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    follow(event);
  });
  canvas.addEventListener("pointermove", follow);
  canvas.addEventListener("keydown", (event) => {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const [right, up] = arrows[event.key] ?? [];
    if (right === undefined) return;
    event.preventDefault();
    const { x = 0, y = 0 } = lamps[0] ?? {};
    shineFrom(x + 0.08 * right, y + 0.08 * up);
  });
  for (const name of ["specular", "detail"]) {
    get(name).value = look[name];
    get(name).addEventListener("input", () => {
      look[name] = get(name).valueAsNumber;
      refresh();
    });
  }
  get("coloured").checked = look.coloured;
  get("coloured").addEventListener("change", () => {
    look.coloured = get("coloured").checked;
    refresh();
  });

  /** A painter by WebGL2; nothing where there is none. */
  function byShader([normals, albedo]) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false });
    if (!gl) return undefined;
    const program = gl.createProgram();
    for (const [kind, text] of [
      [gl.VERTEX_SHADER, data.vertex],
      [gl.FRAGMENT_SHADER, data.fragment],
    ]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    const at = (name) => gl.getUniformLocation(program, name);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    for (const [unit, name, picture, kind] of [
      [0, "normals", normals, gl.RGBA8],
      [1, "albedo", albedo, gl.SRGB8_ALPHA8],
    ]) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
      for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
        gl.texParameteri(gl.TEXTURE_2D, side, gl.LINEAR);
      }
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
      gl.texImage2D(gl.TEXTURE_2D, 0, kind, gl.RGBA, gl.UNSIGNED_BYTE, picture);
      gl.uniform1i(at(name), unit);
    }
    gl.uniform1f(at("encoded"), 1);
    gl.uniform4f(at("place"), 0, 0, width, height);
    return () => {
      gl.viewport(0, 0, width, height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.uniform3fv(
        at("lamps"),
        lamps.flatMap(({ x, y, brightness }) => [x, y, brightness]),
      );
      gl.uniform1i(at("count"), lamps.length);
      const slope = look.flipped ? -look.detail : look.detail;
      gl.uniform4f(at("look"), look.diffuse, look.specular, 2 ** (1 + 9 * look.gloss), slope);
      gl.uniform1f(at("coloured"), look.coloured ? 1 : 0);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    };
  }

  /** A painter by the processor: one matt lamp, in fewer pixels. */
  function byProcessor(pictures) {
    const step = Math.ceil(Math.max(width, height) / 480);
    [canvas.width, canvas.height] = [Math.ceil(width / step), Math.ceil(height / step)];
    const drawing = canvas.getContext("2d", { willReadFrequently: true });
    const [normals, albedo] = pictures.map((picture) => {
      drawing.clearRect(0, 0, canvas.width, canvas.height);
      drawing.drawImage(picture, 0, 0, canvas.width, canvas.height);
      return drawing.getImageData(0, 0, canvas.width, canvas.height);
    });
    const shown = new ImageData(canvas.width, canvas.height);
    return () => {
      const { x = 0, y = 0 } = lamps[0] ?? {};
      const z = Math.sqrt(Math.max(1 - x * x - y * y, 0));
      for (let at = 0; at < shown.data.length; at += 4) {
        const [a, b, c] = [0, 1, 2].map((channel) => normals.data[at + channel] / 127.5 - 1);
        const facing = Math.max(a * x + b * y + c * z, 0) ** (1 / 2.2);
        for (let channel = 0; channel < 3; channel++) {
          shown.data[at + channel] = facing * (look.coloured ? albedo.data[at + channel] : 205);
        }
        shown.data[at + 3] = albedo.data[at + 3];
      }
      drawing.putImageData(shown, 0, 0);
    };
  }

  function load(address) {
    const picture = new Image();
    picture.src = address;
    return picture.decode().then(() => picture);
  }

  Promise.all([load(data.normals), load(data.albedo)]).then(
    (pictures) => {
      paint = byShader(pictures) ?? byProcessor(pictures);
      paint();
    },
    () => {
      get("problem").textContent = data.unreadable;
    },
  );
})();
