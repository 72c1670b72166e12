//! Folders as people and their programs leave them.
use crate::common::{encode, file, mask_png, shaded_png};
use image::{DynamicImage, GrayImage, ImageFormat};
use normalight_core::MaskSource;
use normalight_io::{
    IoError, LeftOutReason, NamedBytes, Notice, Order, ReadOptions, StackInput, read_stack,
};

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &ReadOptions::default())
}

fn shots(name: impl Fn(u32) -> String) -> Vec<NamedBytes> {
    (1..=5)
        .map(|k| file(&name(k), shaded_png(16, 12, k)))
        .collect()
}

fn encode_black(width: u32, height: u32) -> Vec<u8> {
    encode(
        &DynamicImage::ImageLuma8(GrayImage::new(width, height)),
        ImageFormat::Png,
    )
}

fn junk(name: &str) -> NamedBytes {
    file(name, b"nothing of use".to_vec())
}

#[test]
fn maps_of_other_programs_are_left_out_and_named() {
    let mut files = shots(|k| format!("L ({k}).png"));
    let maps = [
        "baseColor.png",
        "roughness.png",
        "metallic.png",
        "error.png",
        "Normal.png",
        "L_height.png",
    ];
    files.extend(maps.map(|name| file(name, shaded_png(16, 12, 9))));
    files.push(junk("shot.HEIC"));
    files.push(junk("IMG_1.NEF"));
    let input = read(files).unwrap();
    assert_eq!(input.file_names.len(), 5);
    let left_out = |name: &str| {
        input
            .plan
            .left_out
            .iter()
            .find(|left| left.file == name)
            .unwrap()
    };
    for map in maps {
        assert!(
            matches!(left_out(map).reason, LeftOutReason::Map { .. }),
            "{map}"
        );
    }
    assert!(
        matches!(&left_out("shot.HEIC").reason, LeftOutReason::UnreadFormat { format } if format == "HEIC")
    );
    assert!(matches!(
        &left_out("IMG_1.NEF").reason,
        LeftOutReason::UnreadFormat { .. }
    ));
    let said = input.plan.to_string();
    assert!(
        said.contains("baseColor.png") && said.contains("photographs: 5"),
        "{said}"
    );
}

#[test]
fn a_word_that_all_names_share_says_nothing() {
    let mut files = shots(|k| format!("Funeral_mask_{k}.png"));
    assert_eq!(read(files.clone()).unwrap().file_names.len(), 5);
    files.push(file("mask.png", mask_png(16, 12, |x, _| x > 3)));
    let input = read(files).unwrap();
    assert_eq!(input.file_names.len(), 5);
    assert_eq!(input.mask_source, MaskSource::File("mask.png".into()));
    let normals = shots(|k| format!("normal light {k}.png"));
    assert_eq!(read(normals).unwrap().file_names.len(), 5);
}

#[test]
fn helper_files_are_no_photographs() {
    let mut files = shots(|k| format!("vase/IMG_{k}.png"));
    for name in [
        "vase/Thumbs.db",
        "vase/desktop.ini",
        "vase/.DS_Store",
        "vase/._IMG_1.png",
        "__MACOSX/vase/IMG_1.png",
        "vase/vase.info",
    ] {
        files.push(junk(name));
    }
    let input = read(files.clone()).unwrap();
    assert_eq!(input.file_names.len(), 5);
    assert_eq!(input.plan.left_out.len(), 6);
    assert!(
        input
            .plan
            .left_out
            .iter()
            .all(|left| left.reason == LeftOutReason::System)
    );
    assert!(
        !input.plan.to_string().contains("Thumbs")
            && format!("{:#}", input.plan).contains("Thumbs")
    );
    let error = read(files[5..].to_vec()).unwrap_err();
    assert!(
        matches!(error, IoError::TooFewImages { found: 0, .. }),
        "{error}"
    );
}

#[test]
fn lists_in_another_spelling_and_lists_of_rejects() {
    let mut files = shots(|k| format!("Bu\u{308}ste_{k}.PNG"));
    files.push(file(
        "rejected.txt",
        b"B\xC3\xBCste_1.png\nB\xC3\xBCste_2.png\n".to_vec(),
    ));
    let input = read(files.clone()).unwrap();
    assert_eq!(
        (input.plan.order.clone(), input.file_names.len()),
        (Order::Names, 5)
    );
    let list = "B\u{fc}ste_3.png\nB\u{fc}ste_1.png\nB\u{fc}ste_2.tif\n";
    files.push(file("names.txt", list.as_bytes().to_vec()));
    let input = read(files).unwrap();
    assert_eq!(input.plan.order, Order::List("names.txt".into()));
    assert_eq!(
        input.file_names,
        [3, 1, 2].map(|k| format!("Bu\u{308}ste_{k}.PNG"))
    );
    assert!(input.plan.notices.contains(&Notice::ListByStem {
        list: "names.txt".into()
    }));
    let unlisted = input
        .plan
        .left_out
        .iter()
        .filter(|left| left.reason == LeftOutReason::NotListed);
    assert_eq!(unlisted.count(), 2);
}

#[test]
fn repeated_names_keep_their_folders_and_copies_are_refused() {
    let input = read(shots(|k| format!("light{k}/IMG.png"))).unwrap();
    assert_eq!(input.picked_names()[4], "light5/IMG.png");
    let mut files = shots(|k| format!("IMG_{k}.png"));
    files.extend(shots(|k| format!("IMG_{k}.tif")));
    let error = read(files).unwrap_err();
    assert!(
        matches!(&error, IoError::Copies { shots: 5, .. }),
        "{error}"
    );
    assert!(
        error.to_string().contains("IMG_1.png and IMG_1.tif"),
        "{error}"
    );
    // Copies may be told apart by a word at the end of their names.
    for [one, other] in [["8bit", "16bit"], ["8_bit", "16_bit"], ["lin", "srgb"]] {
        let mut files = shots(|k| format!("IMG_{k}_{one}.png"));
        files.extend(shots(|k| format!("IMG_{k}_{other}.png")));
        let error = read(files).unwrap_err();
        assert!(
            matches!(&error, IoError::Copies { shots: 5, .. }),
            "{error}"
        );
    }
    // Numbers and heights are no such words.
    let mut files = shots(|k| format!("IMG_{k}_8.png"));
    files.extend(shots(|k| format!("IMG_{k}_16.png")));
    files.extend(shots(|k| format!("IMG_{k}_low.png")));
    assert_eq!(read(files).unwrap().stack.len(), 15);
}

/// Pictures among a series that are named unlike it and unlike each other are none of it; names of lamps are no series.
#[test]
fn a_series_leaves_out_what_is_named_unlike_it() {
    let mut files = shots(|k| format!("IMG_{k}.png"));
    for name in ["T_Vase_N.png", "Vase_1k.png", "overview.png"] {
        files.push(file(name, shaded_png(16, 12, 8)));
    }
    let input = read(files).unwrap();
    assert_eq!(input.file_names.len(), 5);
    let odd = |left: &&normalight_io::LeftOut| left.reason == LeftOutReason::UnlikeNames;
    assert_eq!(input.plan.left_out.iter().filter(odd).count(), 3);
    let lamps = ["left", "right", "top", "below", "front"];
    let files = lamps.iter().zip(1..);
    let files = files.map(|(lamp, k)| file(&format!("{lamp}.png"), shaded_png(16, 12, k)));
    assert_eq!(read(files.collect()).unwrap().file_names.len(), 5);
    let mut two = shots(|k| format!("a_{k}.png"));
    two.extend((1..=2).map(|k| file(&format!("b_{k}.png"), shaded_png(16, 12, k + 5))));
    assert_eq!(read(two).unwrap().file_names.len(), 7);
}

/// Most decide, wherever the odd one lies.
#[test]
fn one_of_another_size_is_left_out() {
    for odd in [1, 3, 5] {
        let mut files = shots(|k| format!("IMG_{k}.png"));
        files[odd - 1] = file(&format!("IMG_{odd}.png"), shaded_png(20, 12, 3));
        let input = read(files).unwrap();
        assert_eq!((input.stack.len(), input.stack.width()), (4, 16));
        let left = &input.plan.left_out[0];
        assert_eq!(left.file, format!("IMG_{odd}.png"));
        assert_eq!(left.reason, LeftOutReason::OtherSize { size: [20, 12] });
        assert_eq!(input.picked_names().len(), 4);
    }
}

#[test]
fn what_is_black_or_nearly_is_left_out() {
    let mut files = shots(|k| format!("IMG_{k}.png"));
    files.push(file("IMG_6.png", encode_black(16, 12)));
    let input = read(files).unwrap();
    assert_eq!((input.stack.len(), input.picked.len()), (5, 5));
    let left = input
        .plan
        .left_out
        .iter()
        .find(|left| left.reason == LeftOutReason::TooDark);
    assert_eq!(left.unwrap().file, "IMG_6.png");
}

/// Many files with the same to say are one line, and names cannot break lines.
#[test]
fn notices_are_gathered() {
    let input = read(shots(|k| format!("IMG_{k}\n.heic"))).unwrap();
    let lines = input.plan.lines(true);
    let told: Vec<&String> = lines
        .iter()
        .filter(|line| line.contains("the extension is"))
        .collect();
    assert_eq!(told.len(), 1, "{lines:?}");
    assert!(
        told[0].starts_with("notice: IMG_1\\n.heic, IMG_2\\n.heic, "),
        "{}",
        told[0]
    );
}

/// Pictures under an extension of another format of pictures, or under none, as after a conversion or a rescue of files.
#[test]
fn content_tells_images_where_the_name_does_not() {
    for name in [
        |k: u32| format!("IMG_{k}.heic"),
        |k| format!("IMG_{k}.CR2"),
        |k| format!("IMG_{k}"),
    ] {
        let mut files = shots(name);
        files.push(file("notes", b"a text".to_vec()));
        files.push(file("IMG_1.jpg_original", shaded_png(16, 12, 8)));
        files.push(file("IMG_2.dng", [b"II*\0".as_slice(), &[0; 400]].concat()));
        let input = read(files).unwrap();
        assert_eq!(input.file_names, (1..=5).map(name).collect::<Vec<_>>());
        let told = |notice: &&Notice| matches!(notice, Notice::ContentOverExtension { content, .. } if content == "PNG");
        assert_eq!(input.plan.notices.iter().filter(told).count(), 5);
        let left: Vec<&str> = input
            .plan
            .left_out
            .iter()
            .map(|left| left.file.as_str())
            .collect();
        assert_eq!(left, ["notes", "IMG_1.jpg_original", "IMG_2.dng"]);
    }
}
