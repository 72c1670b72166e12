/// The pixels of a square picture that show the object.
pub(crate) struct Visible<'a> {
    pub(crate) size: usize,
    pub(crate) pixels: &'a [u32],
}
