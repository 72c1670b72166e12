//! Sets for other people's loaders, and ours.
use super::{IMAGES, ObjectToPublish, PublishedEntry, TRAIN_LIST, VAL_LIST};
use super::{encode, object, read_list_if_there};
use crate::IoError;
use crate::native::aside::{FolderAside, sweep_leftovers};
use crate::native::files::display;
use crate::native::write::{OutputFolder, write_error, write_files};
use normalight_core::{NormalMap, Vec3};
use std::fs;
use std::path::{Path, PathBuf};

/// Which list an entry belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PublishedPart {
    /// `train_mtrl.txt`
    Train,
    /// `val_mtrl.txt`
    Validation,
}

/// Writes a set in the published layout, one object at a time, with its extras: intensities, exact
/// normals, masks and depths.
///
/// Each object is written aside and then renamed, the lists come last: what stands under a final
/// name is complete, and what the lists name is there.
#[derive(Debug)]
pub struct PublishedWriter {
    root: PathBuf,
    train: Vec<PublishedEntry>,
    val: Vec<PublishedEntry>,
}

impl PublishedWriter {
    /// Makes the folder of a set, or goes on with one: the entries of its lists are kept.
    ///
    /// # Errors
    /// [`IoError::Write`]; [`IoError::Read`] or [`IoError::SetLine`] for lists that cannot be kept.
    pub fn create(root: &Path) -> Result<Self, IoError> {
        let images = root.join(IMAGES);
        fs::create_dir_all(&images).map_err(|reason| write_error(&images, reason))?;
        sweep_leftovers(&images);
        Ok(Self {
            root: root.to_owned(),
            train: read_list_if_there(&root.join(TRAIN_LIST))?,
            val: read_list_if_there(&root.join(VAL_LIST))?,
        })
    }

    /// Writes an object. A shape that is there already gets one more material; its normals, mask
    /// and depth stay as they are. An object that is there and in no list, as a killed run leaves
    /// it, is taken as it is when it holds the same.
    ///
    /// # Errors
    /// [`IoError::Exists`] for a material of the shape that is there already, listed or with other files;
    /// [`IoError::SetFormat`] for content that does not fit together, or normals other than those
    /// of the shape; [`IoError::LightCount`]; [`IoError::Encode`]; [`IoError::Write`] naming the
    /// file. After an error nothing of the object is left.
    pub fn write(
        &mut self,
        object: &ObjectToPublish<'_>,
        part: PublishedPart,
    ) -> Result<(), IoError> {
        object.check()?;
        let images = self.root.join(IMAGES);
        let (entry, normals) = (object.entry, object.normals.clone().masked(object.mask)?);
        let shape_folder = entry.shape_folder(&images);
        let material_folder = shape_folder.join(entry.material());
        if material_folder.exists() {
            let mut lists = self.train.iter().chain(&self.val);
            let listed = lists.any(|one| one == entry);
            if listed || !holds(&material_folder, &object.material_files()?) {
                return Err(IoError::Exists {
                    name: display(&material_folder),
                });
            }
            check_same_shape(&shape_folder.join(entry.normals_name()), &normals)?;
            self.list(entry, part);
            return Ok(());
        }
        let aside = FolderAside::new(&images).map_err(|reason| write_error(&images, reason))?;
        let shape_aside = aside.path().join(entry.shape());
        let material_aside = shape_aside.join(entry.material());
        let is_new = !shape_folder.exists();
        if is_new {
            let files = encode::shape_files(entry, &normals, object.mask, object.depth)?;
            write_as(&shape_aside, &shape_folder, &files)?;
        } else {
            check_same_shape(&shape_folder.join(entry.normals_name()), &normals)?;
        }
        write_as(&material_aside, &material_folder, &object.material_files()?)?;
        let (made, goal) = match is_new {
            true => (shape_aside, shape_folder),
            false => (material_aside, material_folder),
        };
        fs::rename(&made, &goal).map_err(|reason| write_error(&goal, reason))?;
        self.list(entry, part);
        Ok(())
    }

    fn list(&mut self, entry: &PublishedEntry, part: PublishedPart) {
        match part {
            PublishedPart::Train => self.train.push(entry.clone()),
            PublishedPart::Validation => self.val.push(entry.clone()),
        }
    }

    /// Writes the lists; without it the set has no new objects.
    ///
    /// # Errors
    /// [`IoError::Write`] naming the list.
    pub fn finish(self) -> Result<(), IoError> {
        let text = |entries: &[PublishedEntry]| -> String {
            entries.iter().map(|entry| format!("{entry}\n")).collect()
        };
        let lists = [(VAL_LIST, text(&self.val)), (TRAIN_LIST, text(&self.train))];
        write_files(&self.root, &lists)
    }
}

/// Whether a folder has these files with this content.
fn holds(folder: &Path, files: &[(String, Vec<u8>)]) -> bool {
    let same = |(name, bytes): &(String, Vec<u8>)| {
        fs::read(folder.join(name)).is_ok_and(|found| found == *bytes)
    };
    files.iter().all(same)
}

/// Writes files into a folder aside; errors name the place where they would have gone.
fn write_as(aside: &Path, goal: &Path, files: &[(String, Vec<u8>)]) -> Result<(), IoError> {
    let written = OutputFolder::prepare(aside).and_then(|folder| folder.write(files));
    written.map_err(|error| match error {
        IoError::Write { name, reason } => IoError::Write {
            name: match Path::new(&name).strip_prefix(aside) {
                Ok(file) if !file.as_os_str().is_empty() => display(&goal.join(file)),
                _ => display(goal),
            },
            reason,
        },
        other => other,
    })
}

/// All materials of a shape share its normals: the same but for a step of their 8 bits.
fn check_same_shape(path: &Path, normals: &NormalMap) -> Result<(), IoError> {
    const STEP: f32 = 2.0 / 255.0;
    let (_, known) = object::read_normals(path)?;
    let size = |map: &NormalMap| (map.width(), map.height());
    let pairs = known.normals().iter().zip(normals.normals());
    let differ = |(one, other): (&Vec3, &Vec3)| (one - other).abs().max_element() > 2.0 * STEP;
    if size(&known) == size(normals) && !pairs.into_iter().any(differ) {
        return Ok(());
    }
    Err(IoError::SetFormat {
        name: display(path),
        found: "other normals than those of the object to be written".to_owned(),
        expected: "one shape in one view for all of its materials".to_owned(),
    })
}
