//! How Protocol Buffers lie in bytes (<https://protobuf.dev/programming-guides/encoding/>), as far as writing needs it.

/// How a field's value is laid out.
#[derive(Clone, Copy)]
enum Layout {
    Varint = 0,
    LengthDelimited = 2,
    FourBytes = 5,
}

/// A message that grows field by field; fields are named by their numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Message(Vec<u8>);

impl Message {
    /// An integer or a value of an enumeration.
    pub(crate) fn integer(mut self, field: u32, value: i64) -> Self {
        self.tag(field, Layout::Varint);
        // Negative numbers take ten bytes, as two's complement of 64 bits.
        self.varint(value as u64);
        self
    }

    pub(crate) fn float(mut self, field: u32, value: f32) -> Self {
        self.tag(field, Layout::FourBytes);
        self.0.extend(value.to_le_bytes());
        self
    }

    pub(crate) fn bytes(mut self, field: u32, value: &[u8]) -> Self {
        self.tag(field, Layout::LengthDelimited);
        self.varint(value.len() as u64);
        self.0.extend(value);
        self
    }

    pub(crate) fn text(self, field: u32, value: &str) -> Self {
        self.bytes(field, value.as_bytes())
    }

    pub(crate) fn message(self, field: u32, value: &Self) -> Self {
        self.bytes(field, &value.0)
    }

    /// A repeated field of integers.
    pub(crate) fn integers(self, field: u32, values: impl IntoIterator<Item = i64>) -> Self {
        let values = values.into_iter();
        values.fold(self, |message, value| message.integer(field, value))
    }

    /// A repeated field of texts.
    pub(crate) fn texts<'a>(self, field: u32, values: impl IntoIterator<Item = &'a str>) -> Self {
        let values = values.into_iter();
        values.fold(self, |message, value| message.text(field, value))
    }

    /// A repeated field of messages.
    pub(crate) fn messages<'a>(
        self,
        field: u32,
        values: impl IntoIterator<Item = &'a Self>,
    ) -> Self {
        let values = values.into_iter();
        values.fold(self, |message, value| message.message(field, value))
    }

    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    fn tag(&mut self, field: u32, layout: Layout) {
        self.varint(u64::from(field << 3 | layout as u32));
    }

    /// Seven bits a byte, the lowest first; all but the last have the eighth.
    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.0.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.0.push(value as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of the format's own description.
    #[test]
    fn bytes_of_the_published_examples() {
        let one = Message::default().integer(1, 150);
        assert_eq!(one.0, [0x08, 0x96, 0x01]);
        let text = Message::default().text(2, "testing");
        assert_eq!(text.0, [0x12, 7, b't', b'e', b's', b't', b'i', b'n', b'g']);
        let inside = Message::default().message(3, &one);
        assert_eq!(inside.0, [0x1a, 0x03, 0x08, 0x96, 0x01]);
        let negative = Message::default().integer(1, -2);
        let mut expected = vec![0x08, 0xfe];
        expected.extend([0xff; 8]);
        expected.push(0x01);
        assert_eq!(negative.0, expected);
        let float = Message::default().float(1, 1.0);
        assert_eq!(float.0, [0x0d, 0, 0, 0x80, 0x3f]);
    }
}
