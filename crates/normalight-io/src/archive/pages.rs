//! The pages of a TIFF file as files of their own.
use super::{Content, Fault, Listing, ReadLimits, Source, Unread};
use crate::decode::PagedTiff;
use crate::format::{base_name, split_extension};
use crate::limits::MAX_FILE_BYTES;
use std::io::Read;

/// Lists the pages of a file of this name.
pub(super) fn open(
    name: &str,
    source: Box<dyn Source>,
) -> Result<(Listing, Box<dyn Content>), Fault> {
    let mut bytes = Vec::new();
    let read = source.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes);
    read.map_err(Fault::damage)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(Fault::too_much(MAX_FILE_BYTES));
    }
    let pages = PagedTiff::open(bytes).ok_or_else(|| Fault::damage("no pages"))?;
    let stem = split_extension(base_name(name)).0;
    let digits = pages.len().to_string().len();
    let files = (1..=pages.len()).map(|page| format!("{stem}_page{page:0digits$}.tif"));
    let listing = Listing {
        files: files.collect(),
        ..Listing::default()
    };
    Ok((listing, Box::new(Pages(pages))))
}

struct Pages(PagedTiff);

impl Content for Pages {
    fn read(&mut self, index: usize, _limits: &ReadLimits) -> Result<Vec<u8>, Unread> {
        Ok(self.0.page(index))
    }
}
