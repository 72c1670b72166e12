use super::ranges::{needs_file, number, range, share, weights};
use super::{MeshFolder, SceneRecipe};
use crate::SynthError;

impl SceneRecipe {
    /// Checks every number of the recipe; files are read by [`crate::Renderer::new`].
    ///
    /// # Errors
    /// The first field out of range, with what was found and what is expected.
    pub fn validate(&self) -> Result<(), SynthError> {
        self.validate_shapes()?;
        self.validate_materials()?;
        self.validate_lights()?;
        share(
            "transport.cast_shadow_share",
            self.transport.cast_shadow_share,
        )?;
        share("transport.bounce_share", self.transport.bounce_share)?;
        share("transport.ambient_share", self.transport.ambient_share)?;
        share("transport.ambient", self.transport.ambient)?;
        self.validate_camera()?;
        let sampling = &self.sampling;
        let field = "sampling.crops_per_scene";
        number(field, sampling.crops_per_scene as f32, 1.0, 32.0, "1..=32")?;
        let field = "sampling.lights_per_scene";
        number(
            field,
            sampling.lights_per_scene as f32,
            1.0,
            256.0,
            "1..=256",
        )
    }

    fn validate_shapes(&self) -> Result<(), SynthError> {
        let shapes = &self.shapes;
        weights(
            "shapes",
            &[
                ("shapes.sphere", shapes.sphere),
                ("shapes.ellipsoid", shapes.ellipsoid),
                ("shapes.blob", shapes.blob),
                ("shapes.lathe", shapes.lathe),
                ("shapes.statue", shapes.statue),
                ("shapes.plate", shapes.plate),
                ("shapes.mesh", shapes.mesh),
            ],
        )?;
        needs_file(
            "shapes.mesh_folders",
            shapes.mesh,
            !shapes.mesh_folders.is_empty(),
            "folders of meshes, because shapes.mesh is positive,",
        )?;
        MeshFolder::validate("shapes.mesh_folders", &shapes.mesh_folders)?;
        MeshFolder::validate("shapes.validation_meshes", &shapes.validation_meshes)?;
        share("shapes.tumbled_share", shapes.tumbled_share)?;
        share("shapes.perspective_share", shapes.perspective_share)?;
        let expected = "[low, high] with 2 <= low <= high <= 100 object sizes";
        range(
            "shapes.camera_distance",
            shapes.camera_distance,
            2.0,
            100.0,
            expected,
        )?;
        let field = "shapes.crease_degrees";
        number(field, shapes.crease_degrees, 0.0, 180.0, "0..=180 degrees")?;
        let field = "shapes.max_tilt_degrees";
        number(field, shapes.max_tilt_degrees, 0.0, 60.0, "0..=60 degrees")?;
        share("shapes.relief_share", shapes.relief_share)?;
        share("shapes.strong_relief_share", shapes.strong_relief_share)?;
        share("shapes.mesh_relief_share", shapes.mesh_relief_share)?;
        share("shapes.fine_relief_share", shapes.fine_relief_share)?;
        share("shapes.open_vessel_share", shapes.open_vessel_share)?;
        let field = "shapes.crop_object_pixels";
        let expected = "[low, high] with 32 <= low <= high <= 1024 pixels";
        range(field, shapes.crop_object_pixels, 32.0, 1024.0, expected)?;
        let expected = "[low, high] with 0 <= low <= high <= 0.3";
        range("shapes.margin", shapes.margin, 0.0, 0.3, expected)
    }

    fn validate_materials(&self) -> Result<(), SynthError> {
        let materials = &self.materials;
        share("materials.metal_share", materials.metal_share)?;
        share("materials.broad_metal_share", materials.broad_metal_share)?;
        share("materials.dark_stone_share", materials.dark_stone_share)?;
        share("materials.matte_share", materials.matte_share)?;
        share(
            "materials.rough_diffuse_share",
            materials.rough_diffuse_share,
        )?;
        share("materials.sheen_share", materials.sheen_share)?;
        share("materials.measured_share", materials.measured_share)?;
        needs_file(
            "materials.measured_file",
            materials.measured_share,
            materials.measured_file.is_some(),
            "a file of measured materials, because materials.measured_share is positive,",
        )?;
        share("materials.mixed_share", materials.mixed_share)?;
        share(
            "materials.rough_texture_share",
            materials.rough_texture_share,
        )?;
        share("materials.brushed_share", materials.brushed_share)?;
        share("materials.textured_share", materials.textured_share)?;
        let expected = "[low, high] with 0 <= low <= high <= 1";
        range("materials.albedo", materials.albedo, 0.0, 1.0, expected)?;
        let expected = "[low, high] with 0 <= low <= high <= 0.2";
        range(
            "materials.dielectric_f0",
            materials.dielectric_f0,
            0.0,
            0.2,
            expected,
        )?;
        let expected = "[low, high] with 0.02 <= low <= high <= 1";
        range(
            "materials.roughness",
            materials.roughness,
            0.02,
            1.0,
            expected,
        )
    }

    fn validate_lights(&self) -> Result<(), SynthError> {
        let lights = &self.lights;
        weights(
            "lights",
            &[
                ("lights.rectangle", lights.rectangle),
                ("lights.cap", lights.cap),
                ("lights.ring", lights.ring),
                ("lights.dome", lights.dome),
                ("lights.path", lights.path),
            ],
        )?;
        let field = "lights.rectangle_degrees";
        number(field, lights.rectangle_degrees, 1.0, 85.0, "1..=85 degrees")?;
        let expected = "[low, high] with 1 <= low <= high <= 85 degrees";
        range(
            "lights.cap_degrees",
            lights.cap_degrees,
            1.0,
            85.0,
            expected,
        )?;
        range(
            "lights.ring_degrees",
            lights.ring_degrees,
            1.0,
            85.0,
            expected,
        )?;
        share("lights.shift_share", lights.shift_share)?;
        let field = "lights.shift_degrees";
        number(field, lights.shift_degrees, 0.0, 45.0, "0..=45 degrees")?;
        share("lights.equal_share", lights.equal_share)?;
        share("lights.mild_share", lights.mild_share)?;
        number(
            "lights.equal_share + mild_share",
            lights.equal_share + lights.mild_share,
            0.0,
            1.0 + 1e-5,
            "at most 1",
        )?;
        let expected = "[low, high] with 0.01 <= low <= high <= 100";
        range("lights.intensity", lights.intensity, 0.01, 100.0, expected)?;
        share("lights.colour_share", lights.colour_share)?;
        number("lights.colour", lights.colour, 0.0, 0.5, "0..=0.5")?;
        share("lights.near_share", lights.near_share)?;
        let expected = "[low, high] with 1 <= low <= high <= 100 object sizes";
        range(
            "lights.near_distance",
            lights.near_distance,
            1.0,
            100.0,
            expected,
        )
    }

    fn validate_camera(&self) -> Result<(), SynthError> {
        let camera = &self.camera;
        let expected = "[low, high] with 0.001 <= low <= high <= 1";
        range("camera.mean", camera.mean, 0.001, 1.0, expected)?;
        share("camera.clip_share", camera.clip_share)?;
        let expected = "[low, high] with 0 <= low <= high <= 0.2";
        range("camera.noise", camera.noise, 0.0, 0.2, expected)?;
        share("camera.linear_8_bit_share", camera.linear_8_bit_share)?;
        share("camera.srgb_8_bit_share", camera.srgb_8_bit_share)?;
        share("camera.jpeg_share", camera.jpeg_share)?;
        let stored = camera.linear_8_bit_share + camera.srgb_8_bit_share + camera.jpeg_share;
        // Sums of shares like 0.7 + 0.1 + 0.2 may round to a little more than one.
        number(
            "camera.linear_8_bit_share + srgb_8_bit_share + jpeg_share",
            stored,
            0.0,
            1.0 + 1e-5,
            "at most 1",
        )?;
        let expected = "[low, high] with 1 <= low <= high <= 100";
        range(
            "camera.jpeg_quality",
            camera.jpeg_quality,
            1.0,
            100.0,
            expected,
        )?;
        share("camera.shift_share", camera.shift_share)?;
        let expected = "[low, high] with 0 <= low <= high <= 2 pixels";
        range(
            "camera.shift_pixels",
            camera.shift_pixels,
            0.0,
            2.0,
            expected,
        )?;
        share("camera.blur_share", camera.blur_share)?;
        let expected = "[low, high] with 0 <= low <= high <= 1 pixels";
        range("camera.blur_pixels", camera.blur_pixels, 0.0, 1.0, expected)
    }
}
