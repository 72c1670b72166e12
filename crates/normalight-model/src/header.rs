//! The header of a safetensors file in one order.
use serde_json::Value;
use std::collections::BTreeMap;

/// Bytes before the header: its length.
const LENGTH: usize = 8;

/// The same file with the entries of its header sorted: the library writes metadata in an order that
/// chance decides, so that equal weights would have different hashes. What is no safetensors file stays
/// as it is.
pub(crate) fn sorted(file: Vec<u8>) -> Vec<u8> {
    rewritten(&file).unwrap_or(file)
}

fn rewritten(file: &[u8]) -> Option<Vec<u8>> {
    let (length, rest) = file.split_first_chunk::<LENGTH>()?;
    let (header, data) =
        rest.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
    let mut entries: BTreeMap<String, Value> = serde_json::from_slice(header).ok()?;
    let mut metadata = BTreeMap::new();
    if let Some(found) = entries.remove("__metadata__") {
        metadata = serde_json::from_value::<BTreeMap<String, String>>(found).ok()?;
    }
    let metadata = serde_json::to_value(metadata).ok()?;
    entries.insert("__metadata__".to_owned(), metadata);
    let mut header = serde_json::to_vec(&entries).ok()?;
    // Data begin at a multiple of eight bytes.
    header.resize(header.len().next_multiple_of(LENGTH), b' ');
    let length = (header.len() as u64).to_le_bytes();
    Some([&length, &header[..], data].concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use safetensors::tensor::{Dtype, SafeTensors, TensorView, serialize};
    use std::collections::HashMap;

    #[test]
    fn equal_weights_are_equal_bytes() {
        let values: Vec<u8> = (0..16).collect();
        let file = || {
            let view =
                |bytes| TensorView::new(Dtype::F16, vec![bytes], &values[..2 * bytes]).unwrap();
            let notes = (0..6).map(|k| (format!("note{k}"), format!("\"{k}\"")));
            let notes: HashMap<String, String> = notes.collect();
            serialize([("b", view(3)), ("a.x", view(8))], Some(notes)).unwrap()
        };
        let once = sorted(file());
        assert!((0..20).all(|_| sorted(file()) == once));
        let [before, after] = [file(), once].map(|file| {
            let tensors = SafeTensors::deserialize(&file).unwrap();
            let (_, header) = SafeTensors::read_metadata(&file).unwrap();
            let values = ["a.x", "b"].map(|name| tensors.tensor(name).unwrap().data().to_vec());
            (values, header.metadata().clone())
        });
        assert_eq!(before, after);
        assert_eq!(sorted(b"no such file".to_vec()), b"no such file");
    }
}
