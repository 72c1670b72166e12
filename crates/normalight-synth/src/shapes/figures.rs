use super::part::Part;
use crate::random::{Random, about_x, about_y, about_z};
use glam::{Mat3, Vec3};

/// Draws an upright figure: y up, facing z, about two units tall or wide.
pub(crate) fn figure(random: &mut Random) -> Vec<Part> {
    match random.below(6) {
        0 => bust(random),
        1 => standing(random),
        2 => seated(random),
        3 => animal(random),
        4 => sitting_animal(random),
        _ => pile(random),
    }
}

/// Adds ellipsoids and limbs with sizes a little off, as no two carvings are alike.
struct Carver<'a> {
    random: &'a mut Random,
    parts: Vec<Part>,
}

impl<'a> Carver<'a> {
    fn new(random: &'a mut Random) -> Self {
        Self {
            random,
            parts: Vec::new(),
        }
    }

    fn about(&mut self, value: f32) -> f32 {
        value * self.random.range(0.82, 1.2)
    }

    fn place(&mut self, [x, y, z]: [f32; 3]) -> Vec3 {
        Vec3::new(x, y, z) + self.random.vector(0.04)
    }

    fn lump(&mut self, centre: [f32; 3], radii: [f32; 3]) {
        let centre = self.place(centre);
        let radii = Vec3::from_array(radii.map(|radius| self.about(radius)));
        let turn = about_z(self.random.signed(0.2)) * about_x(self.random.signed(0.2));
        self.parts.push(Part::ellipsoid(centre, radii, turn));
    }

    fn limb(&mut self, start: [f32; 3], end: [f32; 3], radii: [f32; 2]) {
        let (start, end) = (self.place(start), self.place(end));
        let radii = radii.map(|radius| self.about(radius));
        self.parts.push(Part::capsule(start, end, radii));
    }

    /// Head with nose, ears or hair.
    fn head(&mut self, [x, y, z]: [f32; 3], size: f32) {
        self.lump([x, y, z], [0.8 * size, size, 0.9 * size]);
        if self.random.chance(0.7) {
            let out = z + 0.9 * size;
            self.limb(
                [x, y + 0.1 * size, out],
                [x, y - 0.2 * size, out],
                [0.1 * size; 2],
            );
        }
        if self.random.chance(0.5) {
            self.lump([x, y + 0.8 * size, z], [0.5 * size, 0.4 * size, 0.5 * size]);
        }
    }

    fn plinth(&mut self, y: f32, radius: f32) {
        if self.random.chance(0.5) {
            self.lump([0.0, y, 0.0], [radius, 0.18, 0.85 * radius]);
        }
    }
}

fn bust(random: &mut Random) -> Vec<Part> {
    let mut carver = Carver::new(random);
    carver.head([0.0, 0.5, 0.05], 0.42);
    carver.limb([0.0, 0.2, 0.0], [0.0, -0.3, -0.05], [0.2, 0.25]);
    carver.lump([0.0, -0.5, 0.0], [0.7, 0.32, 0.35]);
    carver.lump([0.0, -0.75, 0.05], [0.5, 0.35, 0.32]);
    carver.plinth(-1.05, 0.5);
    carver.parts
}

fn standing(random: &mut Random) -> Vec<Part> {
    let mut carver = Carver::new(random);
    carver.head([0.0, 0.9, 0.03], 0.2);
    carver.limb([0.0, 0.65, 0.0], [0.0, 0.3, 0.0], [0.16, 0.22]);
    carver.lump([0.0, 0.4, 0.0], [0.32, 0.28, 0.2]);
    if carver.random.chance(0.6) {
        // A robe.
        carver.limb([0.0, 0.2, 0.0], [0.0, -0.85, 0.0], [0.2, 0.38]);
    } else {
        carver.limb([0.12, 0.1, 0.0], [0.18, -0.9, 0.05], [0.16, 0.1]);
        carver.limb([-0.12, 0.1, 0.0], [-0.18, -0.9, 0.0], [0.16, 0.1]);
    }
    arms(&mut carver, 0.5);
    carver.plinth(-1.0, 0.5);
    carver.parts
}

/// Two arms from shoulders at the given height, hanging, raised or holding something in front.
fn arms(carver: &mut Carver, shoulder: f32) {
    for side in [1.0f32, -1.0] {
        let elbow = [
            side * carver.random.range(0.35, 0.6),
            shoulder - carver.random.range(0.1, 0.4),
            carver.random.range(-0.1, 0.3),
        ];
        let hand = [
            side * carver.random.range(0.05, 0.6),
            elbow[1] + carver.random.range(-0.35, 0.35),
            carver.random.range(0.2, 0.5),
        ];
        carver.limb([side * 0.3, shoulder, 0.0], elbow, [0.11, 0.09]);
        carver.limb(elbow, hand, [0.09, 0.07]);
        carver.lump(hand, [0.09, 0.1, 0.09]);
    }
    if carver.random.chance(0.4) {
        carver.lump([0.0, shoulder - 0.3, 0.45], [0.2, 0.15, 0.12]);
    }
}

fn seated(random: &mut Random) -> Vec<Part> {
    let mut carver = Carver::new(random);
    carver.head([0.0, 0.8, 0.05], 0.28);
    carver.lump([0.0, 0.3, 0.0], [0.45, 0.4, 0.3]);
    carver.lump([0.0, -0.15, 0.12], [0.48, 0.42, 0.4]);
    for side in [1.0, -1.0] {
        carver.limb(
            [side * 0.3, -0.55, 0.0],
            [side * 0.72, -0.55, 0.35],
            [0.24, 0.18],
        );
        carver.limb(
            [side * 0.7, -0.6, 0.4],
            [side * -0.1, -0.65, 0.55],
            [0.16, 0.12],
        );
    }
    arms(&mut carver, 0.45);
    carver.plinth(-0.85, 0.9);
    carver.parts
}

fn animal(random: &mut Random) -> Vec<Part> {
    let mut carver = Carver::new(random);
    carver.lump([0.0, 0.1, 0.0], [0.75, 0.36, 0.34]);
    carver.lump([0.45, 0.18, 0.0], [0.32, 0.35, 0.3]);
    let thickness = carver.random.range(0.09, 0.15);
    for x in [0.5, -0.5] {
        for z in [0.18, -0.18] {
            carver.limb([x, 0.0, z], [x, -0.75, z], [1.3 * thickness, thickness]);
        }
    }
    let raise = carver.random.range(-0.1, 0.6);
    carver.limb([0.6, 0.25, 0.0], [0.9, 0.35 + raise, 0.0], [0.24, 0.17]);
    let head = [1.0, 0.4 + raise, 0.0];
    carver.lump(head, [0.3, 0.2, 0.19]);
    for z in [0.15, -0.15] {
        carver.lump([head[0] - 0.1, head[1] + 0.2, z], [0.07, 0.13, 0.06]);
    }
    carver.limb([-0.72, 0.2, 0.0], [-0.95, -0.35, 0.0], [0.07, 0.04]);
    // Usually seen from the side.
    let turn = carver.random.signed(0.7);
    turned(carver.parts, turn)
}

fn sitting_animal(random: &mut Random) -> Vec<Part> {
    let mut carver = Carver::new(random);
    carver.lump([0.0, -0.35, -0.05], [0.5, 0.6, 0.48]);
    carver.lump([0.0, 0.15, 0.05], [0.38, 0.42, 0.36]);
    let head = [0.0, 0.65, 0.15];
    carver.lump(head, [0.36, 0.32, 0.32]);
    carver.lump([0.0, 0.57, 0.45], [0.15, 0.12, 0.14]);
    for side in [1.0, -1.0] {
        carver.lump([side * 0.24, 0.95, 0.1], [0.1, 0.16, 0.07]);
        carver.limb(
            [side * 0.2, 0.0, 0.3],
            [side * 0.2, -0.85, 0.42],
            [0.14, 0.11],
        );
        carver.lump([side * 0.42, -0.65, 0.15], [0.24, 0.3, 0.38]);
    }
    carver.parts
}

/// Fruit in a basket, a group, a rock: many lumps on each other, wider below.
fn pile(random: &mut Random) -> Vec<Part> {
    let mut carver = Carver::new(random);
    let count = carver.random.count(7, 20);
    for index in 0..count {
        let y = -0.8 + 1.6 * index as f32 / count as f32;
        let spread = 0.75 - 0.35 * (y + 0.8);
        let (x, z) = (
            carver.random.signed(spread),
            carver.random.signed(0.5 * spread),
        );
        let size = carver.random.range(0.15, 0.4);
        if carver.random.chance(0.7) {
            carver.lump([x, y, z], [size, 0.9 * size, size]);
        } else {
            let end = [x + carver.random.signed(0.4), y + 0.3, z];
            carver.limb([x, y, z], end, [0.6 * size, 0.4 * size]);
        }
    }
    // Something in the middle, so that nothing floats.
    carver.lump([0.0, -0.2, -0.1], [0.45, 0.8, 0.35]);
    carver.plinth(-0.9, 0.8);
    carver.parts
}

fn turned(parts: Vec<Part>, angle: f32) -> Vec<Part> {
    let turn: Mat3 = about_y(angle);
    parts.iter().map(|part| part.rotated(turn)).collect()
}
