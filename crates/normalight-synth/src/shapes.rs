//! What is photographed: solids as signed distances, and meshes.
mod figures;
mod lathe;
mod layers;
mod library;
mod mesh;
mod objects;
mod overlay;
mod part;
mod plate;
mod ray;
mod relief;
mod shape;
mod vessels;
mod view;
mod window;

pub(crate) use library::{Library, check_apart};
pub(crate) use objects::{Object, object};
pub(crate) use overlay::Overlay;
pub(crate) use view::{Detail, View};
pub(crate) use window::Window;
