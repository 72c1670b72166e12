//! Kinds of archives, by their content.
use crate::format::split_extension;

/// Bytes of a file's beginning that tell its kind: one block of a tar archive.
pub(crate) const HEAD: usize = 512;

/// What an archive is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ArchiveKind {
    Zip,
    Tar,
    /// A tar archive within gzip, or so it is hoped.
    TarGz,
    /// A TIFF whose pages are photographs.
    Pages,
    /// An archive in a format that is not read, by its name.
    Unread(&'static str),
}

impl ArchiveKind {
    /// How people call it.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Zip => "zip",
            Self::Tar => "tar",
            Self::TarGz => "tar.gz",
            Self::Pages => "TIFF of several pages",
            Self::Unread(name) => name,
        }
    }

    /// The kind of a file with this beginning, of [`HEAD`] bytes where it has as many.
    pub(crate) fn of_content(head: &[u8]) -> Option<Self> {
        const MARKS: &[(&[u8], ArchiveKind)] = &[
            (b"PK\x03\x04", ArchiveKind::Zip),
            // Empty ones, and those that were once to be split.
            (b"PK\x05\x06", ArchiveKind::Zip),
            (b"PK\x07\x08", ArchiveKind::Zip),
            (b"\x1F\x8B\x08", ArchiveKind::TarGz),
            (b"7z\xBC\xAF\x27\x1C", ArchiveKind::Unread("7-Zip")),
            (b"Rar!\x1A\x07", ArchiveKind::Unread("RAR")),
            (b"\xFD7zXZ\0", ArchiveKind::Unread("xz")),
            (b"BZh", ArchiveKind::Unread("bzip2")),
            (b"\x28\xB5\x2F\xFD", ArchiveKind::Unread("Zstandard")),
            (b"\x04\x22\x4D\x18", ArchiveKind::Unread("LZ4")),
            (b"\x1F\x9D", ArchiveKind::Unread("compress")),
            (b"MSCF", ArchiveKind::Unread("cabinet")),
        ];
        let marked = MARKS.iter().find(|(mark, _)| head.starts_with(mark));
        match marked {
            Some(&(_, kind)) => Some(kind),
            None => is_tar(head).then_some(Self::Tar),
        }
    }

    /// The kind that a file's extension promises.
    pub(crate) fn of_extension(name: &str) -> Option<Self> {
        Some(
            match split_extension(name).1.to_ascii_lowercase().as_str() {
                "zip" => Self::Zip,
                "tar" => Self::Tar,
                "tgz" | "gz" | "taz" => Self::TarGz,
                "7z" => Self::Unread("7-Zip"),
                "rar" => Self::Unread("RAR"),
                "xz" | "txz" => Self::Unread("xz"),
                "bz2" | "tbz" | "tbz2" => Self::Unread("bzip2"),
                "zst" | "tzst" => Self::Unread("Zstandard"),
                _ => return None,
            },
        )
    }
}

/// Whether these bytes begin a tar archive: the header of its first file bears the sum of its own
/// bytes, its field taken as blanks (POSIX.1-1988, ustar). Old archives have no other mark.
pub(super) fn is_tar(head: &[u8]) -> bool {
    let Some(block) = head.first_chunk::<HEAD>() else {
        return false;
    };
    let blanks = 8 * u32::from(b' ');
    let sum = |bytes: &[u8]| bytes.iter().map(|&byte| u32::from(byte)).sum::<u32>();
    let expected = sum(&block[..148]) + blanks + sum(&block[156..]);
    let header = tar::Header::from_byte_slice(block);
    // The sum of nothing but zeros is that of the blanks, which no program writes.
    block[0] != 0 && header.cksum().is_ok_and(|found| found == expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_and_extension() {
        for (head, kind) in [
            (&b"PK\x03\x04rest"[..], Some(ArchiveKind::Zip)),
            (
                b"7z\xBC\xAF\x27\x1C\0\x04",
                Some(ArchiveKind::Unread("7-Zip")),
            ),
            (b"\x1F\x8B\x08\0", Some(ArchiveKind::TarGz)),
            (b"\x89PNG\r\n\x1A\n", None),
            (b"PK", None),
            (b"", None),
            (&[0; HEAD], None),
        ] {
            assert_eq!(ArchiveKind::of_content(head), kind);
        }
        for (name, kind) in [
            ("a/b.ZIP", Some("zip")),
            ("b.tar.gz", Some("tar.gz")),
            ("b.tar", Some("tar")),
            ("b.png", None),
            ("zip", None),
        ] {
            assert_eq!(
                ArchiveKind::of_extension(name).map(ArchiveKind::label),
                kind
            );
        }
    }

    #[test]
    fn a_tar_is_known_without_its_mark() {
        let mut header = tar::Header::new_old();
        header.set_path("1.png").unwrap();
        header.set_size(5);
        header.set_cksum();
        let mut block = header.as_bytes().to_vec();
        assert_eq!(ArchiveKind::of_content(&block), Some(ArchiveKind::Tar));
        block[3] ^= 1;
        assert_eq!(ArchiveKind::of_content(&block), None);
        assert_eq!(ArchiveKind::of_content(&block[..511]), None);
    }
}
