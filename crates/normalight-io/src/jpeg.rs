/// Whether a JPEG reaches its end mark.
///
/// The decoder fills missing rows of a cut-off file with grey instead of failing, which would pass
/// for a part of the object. An end mark anywhere is not enough: the thumbnail in the metadata has
/// one too, so the segments are walked from the start.
pub(crate) fn is_complete(bytes: &[u8]) -> bool {
    let mut at = 2;
    while let Some(&[mark, kind]) = bytes.get(at..at + 2) {
        match (mark, kind) {
            (0xFF, 0xD9) => return true,
            // Fill bytes, stuffed zeros and restart marks carry no length.
            (0xFF, 0xFF) => at += 1,
            (0xFF, 0x00 | 0x01 | 0xD0..=0xD8) => at += 2,
            (0xFF, _) => {
                let Some(&[high, low]) = bytes.get(at + 2..at + 4) else {
                    return false;
                };
                at += 2 + usize::from(u16::from_be_bytes([high, low]));
            }
            // Entropy-coded data.
            _ => at += 1,
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::is_complete;

    #[test]
    fn end_marks_inside_segments_do_not_count() {
        let thumbnail = [0xFF, 0xD8, 0xFF, 0xE1, 0, 4, 0xFF, 0xD9];
        assert!(!is_complete(&thumbnail));
        let scan = [0xFF, 0xDA, 0, 3, 9, 1, 2, 0xFF, 0, 0xFF, 0xD0, 5];
        let cut = [&thumbnail[..], &scan[..]].concat();
        assert!(!is_complete(&cut));
        // Bytes after the end, as phones append them, are no fault.
        assert!(is_complete(&[&cut[..], &[0xFF, 0xD9, 1, 2]].concat()));
        assert!(!is_complete(&[]));
    }
}
