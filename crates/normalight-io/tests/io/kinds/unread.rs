//! Files that are recognised and refused with what to do.
use crate::kinds::decode;
use normalight_io::IoError;

/// Whatever the extension promises, content that is known is called by its name.
#[test]
fn what_is_not_read_is_named_with_what_to_do() {
    let tar = [&[0; 257][..], b"ustar\x0000"].concat();
    let dicom = [&[0; 128][..], b"DICM"].concat();
    let kinds: [(&[u8], &str, &str); 27] = [
        (b"\0\0\0\x18ftypheic\0\0\0\0mif1heic", "HEIC", "PNG"),
        (b"\0\0\0\x1Cftypmif1\0\0\0\0mif1avifmiaf", "AVIF", "export"),
        (
            b"\0\0\0\x18ftypcrx \0\0\0\x01crx isom",
            "camera RAW",
            "dcraw_emu",
        ),
        (b"\0\0\0\x14ftypqt  \0\0\0\0qt  ", "video", "frame"),
        (
            b"\0\0\0\x20ftypisom\0\0\x02\0isomiso2avc1mp41",
            "video",
            "frame",
        ),
        (b"RIFF\x10\0\0\0AVI LIST", "video", "frame"),
        (b"\xFF\x0A\xFA\x1F\x01", "JPEG XL", "export"),
        (b"\0\0\0\x0CJXL \r\n\x87\n", "JPEG XL", "export"),
        (b"\0\0\0\x0CjP  \r\n\x87\n", "JPEG 2000", "export"),
        (b"\xFF\x4F\xFF\x51\0\x29", "JPEG 2000", "export"),
        (b"GIF89a\x10\0\x10\0", "GIF", "PNG"),
        (b"8BPS\0\x01", "Photoshop", "export"),
        (b"gimp xcf v011", "GIMP", "export"),
        (b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe", "Radiance", "EXR"),
        (b"SIMPLE  =                    T", "FITS", "TIFF"),
        (&dicom, "DICOM", "export"),
        (b"II*\0\x10\0\0\0CR\x02\0", "camera RAW", "dcraw_emu"),
        (b"FUJIFILMCCD-RAW 0201", "camera RAW", "dcraw_emu"),
        (b"IIRO\x08\0\0\0", "camera RAW", "dcraw_emu"),
        (b"IIU\0\x08\0\0\0", "camera RAW", "dcraw_emu"),
        (b"%PDF-1.7", "PDF", "export"),
        (b"PK\x03\x04\x14\0", "archive", "unpack"),
        (b"7z\xBC\xAF\x27\x1C", "archive", "unpack"),
        (&tar, "archive", "unpack"),
        (
            b"version https://git-lfs.github.com/spec/v1\n",
            "Git LFS",
            "git lfs pull",
        ),
        (b"<!DOCTYPE html>", "web page", "ownload"),
        (&[0; 64], "zeros", "download"),
    ];
    for (bytes, words, advice) in kinds {
        for name in ["photos/a.jpg", "b.PNG"] {
            let error = decode(name, bytes).unwrap_err();
            assert!(matches!(&error, IoError::NotAnImage { .. }), "{error}");
            let error = error.to_string();
            assert!(error.starts_with(name), "{error}");
            assert!(
                error.contains(words) && error.contains(advice),
                "{words}: {error}"
            );
        }
    }
}

/// Where nothing but the name is known yet.
#[test]
fn names_alone_are_enough() {
    for (name, words) in [
        ("a.heic", "HEIC"),
        ("a.DNG", "camera RAW"),
        ("a.nef", "camera RAW"),
        ("a.cr3", "camera RAW"),
        ("a.jxl", "JPEG XL"),
        ("a.mov", "video"),
        ("a.zip", "archive"),
        ("a.psd", "Photoshop"),
    ] {
        let error = decode(name, b"whatever").unwrap_err().to_string();
        assert!(error.starts_with(name) && error.contains(words), "{error}");
    }
}
