//! Text of small files, as editors of all systems write it.
use crate::IoError;
use crate::limits::MAX_TEXT_BYTES;

/// Text of a small file: UTF-8 or UTF-16 with or without a byte order mark, else Latin-1; lines end with `\n` or `\r\n`.
///
/// # Errors
/// [`IoError::FileTooLarge`] above [`MAX_TEXT_BYTES`].
pub fn read_text(name: &str, bytes: &[u8]) -> Result<String, IoError> {
    if bytes.len() as u64 > MAX_TEXT_BYTES {
        return Err(IoError::FileTooLarge {
            name: name.to_owned(),
            found: bytes.len() as u64,
            limit: MAX_TEXT_BYTES,
        });
    }
    let wide = |rest: &[u8], order: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = rest.as_chunks::<2>().0.iter().map(|&b| order(b)).collect();
        String::from_utf16_lossy(&units)
    };
    let text = match bytes {
        [0xFF, 0xFE, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => wide(rest, u16::from_be_bytes),
        [0xEF, 0xBB, 0xBF, rest @ ..] => String::from_utf8_lossy(rest).into_owned(),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            // Every byte is a letter there, so names keep their length.
            Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
        },
    };
    // As old Macintosh programs end lines.
    Ok(match text.contains('\n') {
        true => text,
        false => text.replace('\r', "\n"),
    })
}

#[cfg(test)]
mod tests {
    use super::read_text;

    #[test]
    fn editors_of_all_systems() {
        let text = "B\u{fc}ste 1\r\n";
        let utf16 = |order: fn(u16) -> [u8; 2]| -> Vec<u8> {
            std::iter::once(0xFEFF)
                .chain(text.encode_utf16())
                .flat_map(order)
                .collect()
        };
        let marked = format!("\u{feff}{text}");
        for bytes in [
            text.as_bytes().to_vec(),
            marked.into_bytes(),
            utf16(u16::to_le_bytes),
            utf16(u16::to_be_bytes),
            b"B\xFCste 1\r\n".to_vec(),
        ] {
            assert_eq!(read_text("a.txt", &bytes).unwrap(), text);
        }
    }
}
