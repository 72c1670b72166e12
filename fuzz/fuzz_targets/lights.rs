//! Light files of every kind; what is understood is written and read again.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{check_lights, check_writing, said};
use normalight_io::{LightAxes, read_lights};

const FILES: [&str; 4] = ["l.lp", "l.csv", "light_directions.txt", "l.npy"];
const PHOTOGRAPHS: [&str; 6] = [
    "a1.png",
    "b 2.png",
    "c/3.png",
    "10.tif",
    "B\u{fc}ste.jpg",
    "\"5\".png",
];

fuzz_target!(|data: &[u8]| {
    let Some((&[file, count], bytes)) = data.split_first_chunk() else {
        return;
    };
    let name = FILES[usize::from(file) % FILES.len()];
    let names: Vec<String> = PHOTOGRAPHS.map(str::to_owned).into();
    let names = &names[..usize::from(count) % (names.len() + 1)];
    if let Some(lights) = said(name, read_lights(name, bytes, names)) {
        check_lights(&lights, names.len());
        check_writing(names, &lights);
    }
    if let Ok(axes) = String::from_utf8_lossy(bytes).parse::<LightAxes>() {
        assert_eq!(axes.to_string().parse(), Ok(axes));
    }
});
