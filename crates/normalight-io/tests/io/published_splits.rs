//! Training and validation parts of a set.
use normalight_io::{IoError, PublishedEntry, PublishedSet, PublishedSplit, write_files};
use std::collections::BTreeSet;

fn set(train: &[String], val: &[String]) -> PublishedSet {
    let place = tempfile::tempdir().unwrap();
    let lists = [
        ("train_mtrl.txt", train.join("\n")),
        ("val_mtrl.txt", val.join("\n")),
    ];
    write_files(place.path(), &lists).unwrap();
    PublishedSet::open(place.path()).unwrap()
}

fn lines(shapes: usize, materials: usize) -> Vec<String> {
    let shapes =
        (0..shapes).flat_map(|shape| (0..materials).map(move |m| format!("s{shape}/m{m}")));
    shapes.collect()
}

fn shapes(entries: &[PublishedEntry]) -> BTreeSet<&str> {
    entries.iter().map(PublishedEntry::shape).collect()
}

fn assert_disjoint(split: &PublishedSplit) {
    let train: BTreeSet<_> = split.train.iter().collect();
    assert!(split.validation.iter().all(|entry| !train.contains(entry)));
    assert!(!split.train.is_empty() && !split.validation.is_empty());
}

#[test]
fn a_search_validates_on_other_shapes() {
    let all = lines(10, 100);
    let set_of_ten = set(&all, &[]);
    let split = set_of_ten.search_split(7, 0.1).unwrap();
    assert_eq!((split.train.len(), split.validation.len()), (80, 20));
    assert!(shapes(&split.train).is_disjoint(&shapes(&split.validation)));
    assert_eq!(shapes(&split.validation).len(), 2);
    assert_eq!(shapes(&split.train).len(), 8);
    assert_eq!(set_of_ten.search_split(7, 0.1).unwrap(), split);
    assert_ne!(set_of_ten.search_split(8, 0.1).unwrap(), split);
    let mut turned = all.clone();
    turned.reverse();
    turned.push(all[3].clone());
    assert_eq!(set(&turned, &[]).search_split(7, 0.1).unwrap(), split);
    let whole = set_of_ten.search_split(7, 1.0).unwrap();
    assert_eq!(whole.train.len() + whole.validation.len(), 1000);
}

#[test]
fn small_sets_are_split_too() {
    for shapes_in_set in 2..9 {
        for share in [0.0, 0.1, 1.0, f64::NAN] {
            let split = set(&lines(shapes_in_set, 2), &[])
                .search_split(1, share)
                .unwrap();
            assert_disjoint(&split);
            assert!(shapes(&split.train).is_disjoint(&shapes(&split.validation)));
        }
    }
    let one = set(&lines(1, 50), &[]);
    let error = one.search_split(1, 0.1).unwrap_err();
    assert!(matches!(&error, IoError::SetFormat { name, .. } if name.ends_with("train_mtrl.txt")));
    assert_eq!(one.train_split(1).unwrap().validation.len(), 1);
    assert!(set(&lines(1, 1), &[]).train_split(1).is_err());
}

#[test]
fn training_takes_the_lists_or_one_in_a_hundred() {
    let given = set(&lines(3, 3), &["s9/m0".to_owned()]);
    let split = given.train_split(5).unwrap();
    assert_eq!(
        (&split.train[..], &split.validation[..]),
        (given.train(), given.val())
    );
    let all = lines(20, 50);
    let split = set(&all, &[]).train_split(5).unwrap();
    assert_disjoint(&split);
    assert_eq!((split.train.len(), split.validation.len()), (990, 10));
    let mut turned = all;
    turned.reverse();
    assert_eq!(set(&turned, &[]).train_split(5).unwrap(), split);
    assert_ne!(set(&turned, &[]).train_split(6).unwrap(), split);
}
