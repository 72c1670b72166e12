//! Which page of a TIFF is taken, and what is refused, always by name.
use crate::kinds::writer::{self, bits, short, tiff};
use crate::kinds::{decode, notices};
use normalight_core::Samples;
use normalight_io::{IoError, Notice};

/// What cannot be read right is refused in words, never read wrong.
#[test]
fn tiffs_that_are_refused() {
    let cmyk = tiff(2, 1, &[bits(4, 8), short(262, 5), short(277, 4)], &[0; 8]);
    let five = tiff(2, 1, &[bits(5, 8), short(262, 1), short(277, 5)], &[5; 10]);
    let dng = tiff(
        2,
        1,
        &[bits(1, 8), short(262, 1), (50_706, 1, vec![1])],
        &[5; 2],
    );
    for (bytes, words) in [(cmyk, "CMYK"), (five, "5 channels"), (dng, "RAW")] {
        let error = decode("a.tif", &bytes).unwrap_err().to_string();
        assert!(
            error.starts_with("a.tif:") && error.contains(words) && error.contains("export"),
            "{error}"
        );
    }
}

#[test]
fn the_first_picture_among_pages_is_taken_and_told() {
    let told = |pages: &[(u8, bool)]| {
        let found = decode("a.tif", &writer::pages(pages, 0)).unwrap().image;
        let Samples::U8(codes) = found.samples else {
            panic!()
        };
        (codes[0], notices("tif", |turn| writer::pages(pages, turn)))
    };
    let several = |pages, page| Notice::SeveralPages {
        file: "1.tif".to_owned(),
        pages,
        page,
    };
    let (first, notices) = told(&[(9, false), (70, false), (50, false)]);
    assert_eq!(first, 9);
    assert!(notices.contains(&several(3, 1)), "{notices:?}");
    let (first, notices) = told(&[(9, true), (70, false)]);
    assert_eq!(first, 70);
    assert!(notices.contains(&several(2, 2)), "{notices:?}");
    let error = decode("a.tif", &writer::pages(&[(9, true)], 0)).unwrap_err();
    assert!(error.to_string().contains("previews only"), "{error}");
}

/// RAW files begin with a small preview, the mosaic lies in a directory below.
#[test]
fn the_preview_of_a_raw_file_is_never_taken() {
    for (tag, value) in [(262, 32_803), (262, 34_892), (259, 34_713)] {
        let bytes = writer::below(tag, value);
        for name in ["a.tif", "DSC_0001.tif"] {
            let error = decode(name, &bytes).unwrap_err().to_string();
            assert!(
                error.starts_with(name) && error.contains("RAW") && error.contains("dcraw_emu"),
                "{error}"
            );
        }
    }
}

/// Found by damage at random: the second channel, of one, was taken for transparency.
#[test]
fn kinds_of_channels_that_are_not_there_mean_nothing() {
    for said in [vec![2], vec![0, 2], vec![0, 0, 1]] {
        let tags = [bits(1, 8), short(262, 1), (338, 3, said)];
        let found = decode("a.tif", &tiff(2, 1, &tags, &[5, 7])).unwrap();
        assert_eq!(found.image.samples, Samples::U8(vec![5, 7]));
        assert!(found.alpha.is_none());
    }
}

#[test]
fn other_refusals_name_what_was_found() {
    let method = |method| {
        let tags = [bits(1, 8), short(262, 1), short(259, method)];
        tiff(2, 1, &tags, &[0; 2])
    };
    let of = |bits_of: (u16, u16, Vec<u32>), photometric, kind| {
        let tags = [bits_of, short(262, photometric), short(339, kind)];
        tiff(2, 1, &tags, &[0; 16])
    };
    let shared = tiff(2, 2, &[bits(3, 8), short(262, 6), short(277, 3)], &[9; 12]);
    for (bytes, words) in [
        (method(34_712), "JPEG 2000"),
        (method(34_887), "LERC"),
        (method(34_925), "LZMA"),
        (method(6), "TIFF 6.0"),
        (method(12_345), "compression 12345"),
        (of(bits(1, 24), 1, 3), "floating-point samples of 24 bits"),
        (of(bits(1, 24), 1, 1), "24 bits"),
        (of(bits(1, 64), 1, 6), "complex"),
        (of(bits(1, 8), 9, 1), "Lab"),
        (shared, "share"),
    ] {
        let error = decode("a.tif", &bytes).unwrap_err();
        assert!(matches!(&error, IoError::Unread { .. }), "{error}");
        let error = error.to_string();
        assert!(error.contains(words) && error.contains("export"), "{error}");
    }
}
