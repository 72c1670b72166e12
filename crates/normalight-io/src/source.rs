//! Files by name, wherever their bytes are, and the stack in them.
use crate::archive::{HEAD, Source};
use crate::assemble::assemble;
use crate::packed::Packed;
use crate::plan::{StackPlan, content_decides, find_list, plan_contents};
use crate::text::read_text;
use crate::{IoError, NamedBytes, ReadOptions, StackInput};
use normalight_core::MIN_IMAGES;
use std::io::Cursor;

/// Files of an input.
pub(crate) trait FileSource {
    /// Their names.
    fn names(&self) -> &[String];

    /// A file's name for messages.
    fn label(&self, index: usize) -> String {
        self.names()[index].clone()
    }

    /// The text of a small file.
    fn text(&mut self, index: usize) -> Result<String, IoError>;

    /// The bytes of a file, which are handed out once.
    fn take(&mut self, index: usize) -> Result<Vec<u8>, IoError>;

    /// The first bytes of a file, at most `length`; none where they cannot be had without the rest.
    fn head(&mut self, _index: usize, _length: usize) -> Result<Vec<u8>, IoError> {
        Ok(Vec::new())
    }
}

/// Files that archives may be among.
pub(crate) trait LooseFiles: FileSource {
    /// A file to be read piece by piece, which is handed out once.
    fn open(&mut self, index: usize) -> Result<Box<dyn Source>, IoError>;

    /// Shows the bytes of a file, which stays to be taken.
    fn look(&mut self, index: usize, at: &mut dyn FnMut(&[u8])) -> Result<(), IoError>;

    /// Says where photographs are when there are none among the files.
    fn look_elsewhere(&self) -> Result<(), IoError> {
        Ok(())
    }
}

/// Files in memory.
pub(crate) struct MemoryFiles {
    names: Vec<String>,
    contents: Vec<Vec<u8>>,
}

impl MemoryFiles {
    pub(crate) fn new(files: Vec<NamedBytes>) -> Self {
        let (names, contents) = files
            .into_iter()
            .map(|file| (file.name, file.bytes))
            .unzip();
        Self { names, contents }
    }
}

impl FileSource for MemoryFiles {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn text(&mut self, index: usize) -> Result<String, IoError> {
        read_text(&self.names[index], &self.contents[index])
    }

    fn take(&mut self, index: usize) -> Result<Vec<u8>, IoError> {
        Ok(std::mem::take(&mut self.contents[index]))
    }

    fn head(&mut self, index: usize, length: usize) -> Result<Vec<u8>, IoError> {
        let bytes = &self.contents[index];
        Ok(bytes[..bytes.len().min(length)].to_vec())
    }
}

impl LooseFiles for MemoryFiles {
    fn open(&mut self, index: usize) -> Result<Box<dyn Source>, IoError> {
        Ok(Box::new(Cursor::new(self.take(index)?)))
    }

    fn look(&mut self, index: usize, at: &mut dyn FnMut(&[u8])) -> Result<(), IoError> {
        at(&self.contents[index]);
        Ok(())
    }
}

/// Reads the stack in some files: photographs, and possibly a list and a mask. Archives among them
/// are opened where the files beside them are too few for a stack. `place` is what messages call
/// them all; without it, their list or "the given files".
pub(crate) fn read_files(
    place: Option<&str>,
    mut files: Box<dyn LooseFiles>,
    options: &ReadOptions,
) -> Result<StackInput, IoError> {
    let loose = Planned::of(&mut *files);
    let is_enough = match &loose {
        Ok(planned) => planned.plan.images.len() >= MIN_IMAGES,
        // What a list names may be in an archive beside it.
        Err(error) => !matches!(error, IoError::ListedFileMissing { .. }),
    };
    if is_enough {
        return loose?.read(place, &mut *files, options);
    }
    if let Ok(Planned { plan, list: None }) = &loose
        && plan.images.is_empty()
    {
        files.look_elsewhere()?;
    }
    match Packed::open(files, "")? {
        Ok(packed) => packed.read(options),
        Err(mut files) => loose?.read(place, &mut *files, options),
    }
}

/// A plan, and the list that decided.
pub(crate) struct Planned {
    plan: StackPlan,
    list: Option<String>,
}

impl Planned {
    pub(crate) fn of(files: &mut dyn FileSource) -> Result<Self, IoError> {
        let names = files.names().to_vec();
        let list = find_list(&names, |index| files.text(index))?;
        let list = list.map(|(index, text)| (files.label(index), text));
        let mut heads = Vec::new();
        for (index, name) in names.iter().enumerate() {
            if content_decides(name) {
                // What cannot be read is left out like any other file that is no image.
                heads.push((index, files.head(index, HEAD).unwrap_or_default()));
            }
        }
        let plan = plan_contents(
            &names,
            &heads,
            list.as_ref()
                .map(|(name, text)| (name.as_str(), text.as_str())),
        )?;
        let list = list.map(|(name, _)| name);
        Ok(Self { plan, list })
    }

    /// Adds what else there is to say about the files.
    pub(crate) fn with(mut self, said: StackPlan) -> Self {
        self.plan.left_out.extend(said.left_out);
        self.plan.notices.splice(0..0, said.notices);
        self
    }

    pub(crate) fn read(
        self,
        place: Option<&str>,
        files: &mut dyn FileSource,
        options: &ReadOptions,
    ) -> Result<StackInput, IoError> {
        let place = place
            .or(self.list.as_deref())
            .unwrap_or("the given files")
            .to_owned();
        let names = files.names().to_vec();
        assemble(&place, &names, self.plan, options, |index| {
            files.take(index)
        })
    }
}
