//! Archives written byte by byte after APPNOTE.TXT 6.3.10 (zip) and POSIX.1-1988 (tar).
use flate2::write::{DeflateEncoder, GzEncoder};
use flate2::{Compression, Crc};
use normalight_io::NamedBytes;
use std::io::Write;

/// An entry of a zip archive as it is written, true or not.
#[derive(Clone)]
pub struct ZipEntry {
    pub name: Vec<u8>,
    /// Bit 0: encrypted; bit 11: the name is UTF-8.
    pub flags: u16,
    /// 0: stored; 8: deflated.
    pub method: u16,
    pub packed: Vec<u8>,
    pub size: u32,
    pub crc: u32,
    /// Unix mode, as in the upper half of the external attributes.
    pub mode: u16,
}

impl ZipEntry {
    pub fn stored(name: &str, bytes: &[u8]) -> Self {
        let mut crc = Crc::new();
        crc.update(bytes);
        Self {
            name: name.as_bytes().to_vec(),
            flags: 1 << 11,
            method: 0,
            packed: bytes.to_vec(),
            size: bytes.len() as u32,
            crc: crc.sum(),
            mode: 0o100_644,
        }
    }

    pub fn deflated(name: &str, bytes: &[u8]) -> Self {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(bytes).unwrap();
        Self {
            method: 8,
            packed: encoder.finish().unwrap(),
            ..Self::stored(name, bytes)
        }
    }
}

pub fn zip(entries: &[ZipEntry]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for entry in entries {
        let offset = bytes.len() as u32;
        let mut common = Vec::new();
        for field in [20, entry.flags, entry.method, 0, 0x21] {
            common.extend(field.to_le_bytes());
        }
        for field in [entry.crc, entry.packed.len() as u32, entry.size] {
            common.extend(field.to_le_bytes());
        }
        common.extend((entry.name.len() as u16).to_le_bytes());
        common.extend([0; 2]);
        bytes.extend(b"PK\x03\x04");
        bytes.extend(&common);
        bytes.extend(&entry.name);
        bytes.extend(&entry.packed);
        // Made by Unix.
        directory.extend(b"PK\x01\x02\x14\x03");
        directory.extend(&common);
        directory.extend([0; 6]);
        directory.extend((u32::from(entry.mode) << 16).to_le_bytes());
        directory.extend(offset.to_le_bytes());
        directory.extend(&entry.name);
    }
    let (start, size) = (bytes.len() as u32, directory.len() as u32);
    bytes.extend(directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    bytes.extend([entries.len() as u16; 2].map(u16::to_le_bytes).concat());
    bytes.extend([size, start].map(u32::to_le_bytes).concat());
    bytes.extend([0; 2]);
    bytes
}

/// All files, deflated.
pub fn zip_of(files: &[NamedBytes]) -> Vec<u8> {
    let entries = files
        .iter()
        .map(|file| ZipEntry::deflated(&file.name, &file.bytes));
    zip(&entries.collect::<Vec<_>>())
}

/// One file of a tar archive; `kind` is `b'0'` for a file, `b'2'` for a link, `b'5'` for a folder,
/// `b'L'` for a long name.
pub fn tar_entry(name: &[u8], kind: u8, bytes: &[u8]) -> Vec<u8> {
    let mut header = [0; 512];
    header[..name.len()].copy_from_slice(name);
    header[100..108].copy_from_slice(b"0000644\0");
    header[124..136].copy_from_slice(format!("{:011o}\0", bytes.len()).as_bytes());
    header[156] = kind;
    // What GNU's program writes.
    header[257..265].copy_from_slice(b"ustar  \0");
    header[148..156].fill(b' ');
    let sum: u32 = header.iter().map(|&byte| u32::from(byte)).sum();
    header[148..156].copy_from_slice(format!("{sum:06o}\0 ").as_bytes());
    let mut entry = header.to_vec();
    entry.extend(bytes);
    entry.resize(entry.len().next_multiple_of(512), 0);
    entry
}

pub fn tar_end() -> Vec<u8> {
    vec![0; 1024]
}

pub fn tar_of(files: &[NamedBytes]) -> Vec<u8> {
    let mut tar = Vec::new();
    for file in files {
        let mut name = file.name.as_bytes().to_vec();
        if name.len() > 99 {
            tar.extend(tar_entry(
                b"././@LongLink",
                b'L',
                &[&name[..], b"\0"].concat(),
            ));
            name.truncate(99);
        }
        tar.extend(tar_entry(&name, b'0', &file.bytes));
    }
    tar.extend(tar_end());
    tar
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// Every way to pack some files: a name that fits, and the archive.
pub fn all_ways(files: &[NamedBytes]) -> [(&'static str, Vec<u8>); 4] {
    let stored = files
        .iter()
        .map(|file| ZipEntry::stored(&file.name, &file.bytes));
    [
        ("capture.zip", zip(&stored.collect::<Vec<_>>())),
        ("capture.zip", zip_of(files)),
        ("capture.tar", tar_of(files)),
        ("capture.tar.gz", gzip(&tar_of(files))),
    ]
}
