//! Scenes of noise, and a network that was never trained.
use burn::tensor::Device;
use normalight_core::{
    CalibratedStack, ImageStack, Light, Mask, Samples, StackImage, Symmetry, Transfer, Vec3,
};
use normalight_model::{
    Helpers, LoadedNetwork, LoadedNormalNetwork, ModelError, NoHelpers, NormalArchitecture,
    NormalBody, NormalNetwork, Observer, PipelineStage,
};

pub const IMAGES: usize = 3;

/// Rows of pixels: turned here by exchanging and reversing rows, not by formulas for places.
pub type Grid<T> = Vec<Vec<T>>;

fn transposed<T: Copy>(grid: Grid<T>) -> Grid<T> {
    (0..grid[0].len())
        .map(|column| grid.iter().map(|row| row[column]).collect())
        .collect()
}

pub fn turned<T: Copy>(symmetry: Symmetry, mut grid: Grid<T>) -> Grid<T> {
    if symmetry.transposed {
        grid = transposed(grid);
    }
    if symmetry.mirrored {
        grid.iter_mut().for_each(|row| row.reverse());
    }
    if symmetry.upside_down {
        grid.reverse();
    }
    grid
}

pub fn turned_back<T: Copy>(symmetry: Symmetry, mut grid: Grid<T>) -> Grid<T> {
    let mirrorings = Symmetry {
        transposed: false,
        ..symmetry
    };
    grid = turned(mirrorings, grid);
    if symmetry.transposed {
        grid = transposed(grid);
    }
    grid
}

/// Photographs without any symmetry, in which every pixel is noise, with their lights.
#[derive(Clone)]
pub struct Scene {
    pub images: Vec<Grid<[f32; 3]>>,
    pub inside: Grid<bool>,
    pub lights: Vec<Light>,
}

impl Scene {
    /// All pixels but those of `outside` belong to the object.
    pub fn new(width: usize, height: usize, outside: impl Fn(usize, usize) -> bool) -> Self {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        let rows = 0..height;
        let images = (0..IMAGES)
            .map(|_| {
                let row = |_| (0..width).map(|_| [random(), random(), random()]).collect();
                rows.clone().map(row).collect()
            })
            .collect();
        let directions = [[0.3, 0.5, 0.8], [-0.6, 0.1, 0.7], [0.2, -0.4, 0.9]];
        let light = |(k, direction)| Light {
            intensity: [0.8, 1.0, 1.1 + 0.3 * k as f32],
            ..Light::new(Vec3::from_array(direction), 1.0)
        };
        Self {
            images,
            inside: rows
                .map(|y| (0..width).map(|x| !outside(x, y)).collect())
                .collect(),
            lights: directions.into_iter().enumerate().map(light).collect(),
        }
    }

    pub fn turned(&self, symmetry: Symmetry) -> Self {
        let mut scene = self.clone();
        for image in &mut scene.images {
            *image = turned(symmetry, std::mem::take(image));
        }
        scene.inside = turned(symmetry, scene.inside);
        for light in &mut scene.lights {
            light.direction = symmetry.vector(light.direction);
        }
        scene
    }

    pub fn stack(&self) -> ImageStack {
        let image = |image: &Grid<[f32; 3]>| StackImage {
            name: "noise".to_owned(),
            width: image[0].len(),
            height: image.len(),
            channels: 3,
            samples: Samples::F32(image.iter().flatten().flatten().copied().collect()),
            transfer: Transfer::Linear,
        };
        ImageStack::new(self.images.iter().map(image).collect()).unwrap()
    }

    pub fn mask(&self) -> Mask {
        let inside = self.inside.concat();
        Mask::new(self.inside[0].len(), self.inside.len(), inside)
    }
}

/// An untrained network, which treats no two views alike.
pub struct Untrained {
    pub loaded: LoadedNormalNetwork,
}

impl Untrained {
    pub fn new() -> Self {
        Self::of(NormalArchitecture::plain().body)
    }

    pub fn of(body: NormalBody) -> Self {
        let device = Device::flex();
        let architecture = NormalArchitecture {
            mask_channel: true,
            body,
        };
        let network = NormalNetwork::new(&architecture, false, &device).unwrap();
        Self {
            loaded: LoadedNetwork {
                architecture,
                network,
                device,
            },
        }
    }

    pub fn normals(
        &self,
        scene: &Scene,
        views: &[Symmetry],
        observer: &mut impl Observer,
    ) -> Found {
        self.helped(&NoHelpers, scene, views, observer)
    }

    pub fn helped(
        &self,
        helpers: &impl Helpers,
        scene: &Scene,
        views: &[Symmetry],
        observer: &mut impl Observer,
    ) -> Found {
        let (stack, mask) = (scene.stack(), scene.mask());
        let calibrated = CalibratedStack::new(&stack, &mask, &scene.lights)?;
        let stage = PipelineStage::Normals;
        let network = self.loaded.helped_by(helpers);
        let estimated = network.estimate(calibrated, views, stage, observer);
        let map = pollster::block_on(estimated)?.normals;
        let rows = map.normals().chunks_exact(map.width());
        Ok(rows.map(<[Vec3]>::to_vec).collect())
    }
}

pub type Found = Result<Grid<Vec3>, ModelError>;

pub fn furthest(one: &Grid<Vec3>, two: &Grid<Vec3>) -> f32 {
    let pairs = one.iter().flatten().zip(two.iter().flatten());
    pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}
