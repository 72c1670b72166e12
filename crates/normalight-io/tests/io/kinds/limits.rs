//! Limits are settings, and each is kept.
use crate::common::{file, three};
use normalight_io::{IoError, Limits, MAX_PIXELS, ReadOptions, read_stack};

fn read(limits: Limits) -> Result<(), IoError> {
    let options = ReadOptions {
        limits,
        ..ReadOptions::default()
    };
    let mut files = three(16, 12);
    files.push(file("notes.md", b"nothing".to_vec()));
    read_stack(files, &options).map(|_| ())
}

#[test]
fn each_limit_is_kept() {
    assert_eq!(Limits::default().pixels, MAX_PIXELS);
    let area = 16 * 12;
    let limits = |set: fn(&mut Limits, u64), value| {
        let mut limits = Limits::default();
        set(&mut limits, value);
        limits
    };
    let pixels = |value| limits(|limits, value| limits.pixels = value, value);
    assert!(read(pixels(area)).is_ok());
    let error = read(pixels(area - 1)).unwrap_err();
    assert!(
        matches!(&error, IoError::TooManyPixels { name, limit, .. } if name == "1.png" && *limit == area - 1),
        "{error}"
    );
    let stack = |value| limits(|limits, value| limits.stack_bytes = value, value);
    assert!(read(stack(9 * area)).is_ok());
    assert!(matches!(
        read(stack(9 * area - 1)),
        Err(IoError::StackTooLarge { .. })
    ));
    let files = |value| limits(|limits, value| limits.files = value as usize, value);
    assert!(read(files(4)).is_ok());
    assert!(matches!(
        read(files(3)),
        Err(IoError::TooManyFiles {
            found: 4,
            limit: 3,
            ..
        })
    ));
}
