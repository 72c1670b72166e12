//! Drawings read back, for tests.
use std::collections::HashMap;
use svg::node::element::tag::Type;
use svg::parser::Event;

/// One element of a drawing.
#[derive(Debug, Default)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) attributes: HashMap<String, String>,
    /// Its own text, without space around it.
    pub(super) text: String,
    /// Elements directly within it.
    pub(super) children: Vec<Element>,
}

impl Element {
    /// The root of a drawing, after checks that it is well-formed and holds numbers only where there should be some.
    pub(super) fn root(drawing: &[u8]) -> Self {
        let text = std::str::from_utf8(drawing).unwrap();
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        let mut open = vec![Self::default()];
        for event in svg::read(text).unwrap() {
            match event {
                Event::Tag(name, kind, attributes) => {
                    if kind != Type::End {
                        let pairs = attributes.into_iter();
                        open.push(Self {
                            name: name.to_owned(),
                            attributes: pairs.map(|(key, value)| (key, value.into())).collect(),
                            ..Self::default()
                        });
                    }
                    if kind != Type::Start {
                        let closed = open.pop().unwrap();
                        assert_eq!(closed.name, name);
                        open.last_mut().unwrap().children.push(closed);
                    }
                }
                Event::Text(text) => {
                    for reference in text.split('&').skip(1) {
                        let known = ["amp;", "lt;", "gt;"];
                        assert!(known.iter().any(|one| reference.starts_with(one)), "{text}");
                    }
                    assert!(!text.trim().contains(char::is_control), "{text:?}");
                    open.last_mut().unwrap().text += text.trim();
                }
                other => panic!("{other:?}"),
            }
        }
        assert_eq!(open.len(), 1, "not everything is closed");
        let mut roots = open.remove(0).children;
        assert_eq!(roots.len(), 1);
        roots.remove(0)
    }

    pub(super) fn of_class<'a>(&'a self, class: &'a str) -> impl Iterator<Item = &'a Self> + Clone {
        let children = self.children.iter();
        children.filter(move |one| one.attributes.get("class").is_some_and(|own| own == class))
    }

    pub(super) fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> + Clone {
        self.children.iter().filter(move |one| one.name == name)
    }

    pub(super) fn child(&self, name: &str) -> &Self {
        let mut children = self.children.iter();
        children.find(|one| one.name == name).unwrap()
    }

    /// All numbers of an attribute.
    pub(super) fn numbers(&self, attribute: &str) -> Vec<f64> {
        let parts = self.attributes[attribute].split(|one: char| !"-.0123456789".contains(one));
        let parts = parts.filter(|part| !part.is_empty());
        parts.map(|part| part.parse().unwrap()).collect()
    }

    pub(super) fn number(&self, attribute: &str) -> f64 {
        self.numbers(attribute)[0]
    }

    /// Left, top, right and bottom of a rectangle.
    pub(super) fn sides(&self) -> [f64; 4] {
        let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| self.number(name));
        [x, y, x + width, y + height]
    }
}
