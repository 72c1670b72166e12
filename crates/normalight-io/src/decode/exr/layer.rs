//! Layers of an EXR that are pictures.
use exr::math::Vec2;
use exr::meta::header::Header;

/// A picture among the channels of a file.
pub(super) struct Layer {
    /// Index of its part.
    pub(super) part: usize,
    /// Its name, for people.
    pub(super) name: String,
    /// Indices of its channels: R, G, B or one of grey, and A when there is one.
    pub(super) channels: Vec<usize>,
    is_grey: bool,
}

impl Layer {
    /// Whether several pixels share samples of the part, which the library cannot unpack, or its
    /// colours are differences to luminance.
    pub(super) fn is_luminance_chroma(&self, header: &Header) -> bool {
        let mut list = header.channels.list.iter();
        list.any(|channel| {
            let name = channel.name.to_string();
            let difference = name.ends_with("RY") || name.ends_with("BY");
            channel.sampling != Vec2(1, 1) || (self.is_grey && difference)
        })
    }
}

/// Pictures with colours, then grey ones, each in the order of the file; the unnamed layer and
/// those that renderers call the finished picture come first.
pub(super) fn layers(headers: &[Header]) -> Vec<Layer> {
    let mut layers: Vec<Layer> = (headers.iter().enumerate())
        .flat_map(|(part, header)| of_part(part, header, headers.len() > 1))
        .collect();
    layers.sort_by_key(|layer| {
        let name = layer.name.to_ascii_lowercase();
        let finished = ["combined", "beauty", "rgba", "unnamed one"];
        let finished = finished.iter().any(|word| name.ends_with(word));
        (layer.is_grey, !finished)
    });
    layers
}

fn of_part(part: usize, header: &Header, several: bool) -> Vec<Layer> {
    // A channel's name is that of its layer, a dot, and a letter.
    let names: Vec<String> = (header.channels.list.iter())
        .map(|channel| channel.name.to_string())
        .collect();
    let parted: Vec<(&str, String)> = (names.iter())
        .map(|name| {
            let (layer, last) = name.rsplit_once('.').unwrap_or(("", name));
            (layer, last.to_ascii_uppercase())
        })
        .collect();
    let mut prefixes: Vec<&str> = Vec::new();
    for (layer, _) in &parted {
        if !prefixes.contains(layer) {
            prefixes.push(layer);
        }
    }
    let find = |layer: &str, letters: &[&str]| {
        let is = |(at, last): &(&str, String)| *at == layer && letters.contains(&last.as_str());
        parted.iter().position(is)
    };
    let layers = prefixes.into_iter().filter_map(|layer| {
        let find = |letters: &[&str]| find(layer, letters);
        let rgb = [&["R", "RED"], &["G", "GREEN"], &["B", "BLUE"]].map(|letters| find(letters));
        let mut channels: Vec<usize> = match rgb {
            [Some(r), Some(g), Some(b)] => vec![r, g, b],
            // Normals and motion have an X beside their Y.
            [_, None, None] if find(&["X"]).is_none() => {
                vec![rgb[0].or(find(&["Y", "L", "GREY", "GRAY", "LUMINANCE"]))?]
            }
            _ => return None,
        };
        let is_grey = channels.len() == 1;
        channels.extend(find(&["A", "ALPHA"]));
        let part_name = header.own_attributes.layer_name.as_ref();
        let part_name = part_name.map(ToString::to_string).filter(|_| several);
        let words: Vec<String> = part_name
            .into_iter()
            .chain((!layer.is_empty()).then(|| layer.to_owned()))
            .collect();
        Some(Layer {
            part,
            name: match words.is_empty() {
                true => "the unnamed one".to_owned(),
                false => words.join("/"),
            },
            channels,
            is_grey,
        })
    });
    layers.collect()
}
