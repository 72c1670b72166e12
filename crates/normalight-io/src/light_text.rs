//! The lines of light files.
use crate::IoError;
use crate::format::format_of_extension;
use crate::names::unquoted;
use crate::text::read_text;
use normalight_core::Vec3;

/// One line of numbers, with the file name that may stand before them.
pub(crate) struct Row {
    pub(crate) file: Option<String>,
    pub(crate) numbers: Vec<f32>,
    line: usize,
    text: String,
}

impl Row {
    pub(crate) fn wrong(&self, name: &str, expected: &str) -> IoError {
        wrong_line(name, self.line, &self.text, expected)
    }
}

/// Lines of numbers, alone or after a name.
pub(crate) struct Rows {
    pub(crate) rows: Vec<Row>,
    /// The number of lines, when the first line says it.
    pub(crate) declared: Option<usize>,
    /// The first of the running numbers that the lines had.
    pub(crate) numbered_from: Option<usize>,
}

/// Lines of `count` numbers (see [`parse_rows`]'s callers), whose first may be the number of lines
/// after it. A running number before the numbers of every line is no number of its own: the lines
/// are brought into its order.
pub(crate) fn parse_rows(name: &str, bytes: &[u8]) -> Result<Rows, IoError> {
    let mut rows = parse_lines(name, bytes)?;
    let declared = rows
        .first()
        .filter(|row| row.file.is_none() && row.numbers.len() == 1)
        .and_then(|row| row.text.parse::<usize>().ok());
    // One number on each line are intensities.
    let declared = declared.filter(|_| rows.get(1).is_none_or(|row| row.numbers.len() > 1));
    if declared.is_some() {
        rows.remove(0);
    }
    Ok(Rows {
        numbered_from: drop_running_numbers(&mut rows),
        rows,
        declared,
    })
}

fn drop_running_numbers(rows: &mut [Row]) -> Option<usize> {
    let width = rows.first()?.numbers.len();
    let numbered = |row: &Row| row.file.is_none() && row.numbers.len() == width;
    if !matches!(width, 2 | 4 | 7) || !rows.iter().all(numbered) {
        return None;
    }
    let whole = |row: &Row| {
        let number = row.numbers[0];
        // A cast of other numbers gives another number.
        (number as usize as f32 == number).then_some(number as usize)
    };
    let numbers: Vec<usize> = rows.iter().map(whole).collect::<Option<_>>()?;
    let first = first_running(&numbers)?;
    rows.sort_by(|a, b| a.numbers[0].total_cmp(&b.numbers[0]));
    for row in rows {
        row.numbers.remove(0);
    }
    Some(first)
}

/// The first of numbers that run from 0 or 1, in any order: places in the order of the photographs. `None` of others,
/// which may be in their names.
pub(crate) fn first_running(numbers: &[usize]) -> Option<usize> {
    let mut sorted = numbers.to_vec();
    sorted.sort_unstable();
    let first = *sorted.first()?;
    let mut places = sorted.iter().enumerate();
    (first <= 1 && places.all(|(place, &number)| number == first + place)).then_some(first)
}

pub(crate) fn check_count(name: &str, found: usize, expected: usize) -> Result<(), IoError> {
    if found == expected {
        return Ok(());
    }
    Err(IoError::LightCount {
        name: name.to_owned(),
        found,
        expected,
    })
}

/// Whether a number can be an intensity: above zero, and small enough for sums over channels and images.
pub(crate) fn is_intensity(value: f32) -> bool {
    value > 0.0 && value < 1e30
}

pub(crate) fn check_direction(vector: Vec3) -> Option<Vec3> {
    // In double precision neither tiny nor huge finite vectors lose their direction.
    let unit = vector.as_dvec3().try_normalize()?.as_vec3();
    unit.is_finite().then_some(unit)
}

pub(crate) fn wrong_line(name: &str, line: usize, found: &str, expected: &str) -> IoError {
    IoError::LightFormat {
        name: name.to_owned(),
        line,
        found: found.chars().take(80).collect(),
        expected: expected.to_owned(),
    }
}

fn parse_lines(name: &str, bytes: &[u8]) -> Result<Vec<Row>, IoError> {
    let text = read_text(name, bytes)?;
    let mut rows = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        // Spreadsheets say first what parts the columns.
        let is_hint = index == 0 && line.to_ascii_lowercase().starts_with("sep=");
        if line.is_empty() || is_hint || line.starts_with(['#', '%']) {
            continue;
        }
        let row = Row {
            file: None,
            line: index + 1,
            text: line.to_owned(),
            numbers: Vec::new(),
        };
        // A name may hold the sign of a comment.
        let bare = line.rsplit_once(" #").or_else(|| line.rsplit_once("\t#"));
        let parsed = parse_line(line).or_else(|| parse_line(bare?.0.trim_end()));
        let Some((file, numbers)) = parsed else {
            return Err(row.wrong(name, "the three numbers x y z, after a file name or alone"));
        };
        rows.push(Row {
            file,
            numbers,
            ..row
        });
    }
    Ok(rows)
}

/// The name and the numbers of a line.
///
/// Commas part numbers (`0.1,0.2`) or are decimal signs (`0,1 0,2`): where spaces or semicolons
/// part the line into numbers already, they are decimal signs.
fn parse_line(line: &str) -> Option<(Option<String>, Vec<f32>)> {
    // A name in quotes may be made of numbers.
    if let Some((file, rest)) = line.strip_prefix('"').and_then(|line| line.split_once('"'))
        && !file.is_empty()
        && let Some((None, numbers)) =
            parse_plain(rest.trim_start_matches(|c| is_space(c) || c == ','))
    {
        return Some((Some(file.to_owned()), numbers));
    }
    parse_plain(line)
}

fn parse_plain(line: &str) -> Option<(Option<String>, Vec<f32>)> {
    take_numbers(line, is_space).or_else(|| take_numbers(line, |c| is_space(c) || c == ','))
}

fn is_space(c: char) -> bool {
    c.is_whitespace() || c == ';'
}

fn take_numbers(
    line: &str,
    parts: impl Fn(char) -> bool + Copy,
) -> Option<(Option<String>, Vec<f32>)> {
    let mut rest = line;
    // From the end of the line, and the name before each count of them.
    let mut numbers = Vec::new();
    let mut before = vec![line];
    loop {
        let end = rest.trim_end_matches(|c| parts(c) || c == ',');
        let start = end.rfind(parts).map_or(0, |at| {
            at + end[at..].chars().next().map_or(1, char::len_utf8)
        });
        let Some(number) = parse_number(&end[start..]) else {
            break;
        };
        numbers.push(number);
        rest = end[..start].trim_end_matches(|c| parts(c) || c == ',');
        before.push(rest);
        if rest.is_empty() {
            numbers.reverse();
            return (numbers.len() <= 7 && numbers.len() != 5).then_some((None, numbers));
        }
    }
    // More numbers (a light and its colour, its brightness, and a confidence) only after the name of an image: other
    // names may end with numbers.
    let named = |&count: &usize| format_of_extension(unquoted(before[count].trim())).is_some();
    let count = [6, 5, 4]
        .into_iter()
        .filter(|&count| count <= numbers.len())
        .find(named)
        .or_else(|| (numbers.len() >= 3).then_some(3))?;
    let file = unquoted(before[count].trim()).to_owned();
    numbers.truncate(count);
    numbers.reverse();
    Some((Some(file), numbers))
}

/// A number with a decimal point or a decimal comma.
pub(crate) fn parse_number(word: &str) -> Option<f32> {
    let word = unquoted(word).trim();
    let word = word.replace('\u{2212}', "-");
    let commas = word.matches(',').count();
    if commas == 1 && !word.contains('.') {
        return word.replace(',', ".").parse().ok();
    }
    word.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(text: &str) -> Option<(Option<String>, Vec<f32>)> {
        parse_line(text)
    }

    #[test]
    fn names_and_numbers_part() {
        let light = vec![-0.25, 0.5, 0.75];
        for text in [
            "a b.png -0.25 0.5 0.75",
            "\"a b.png\"\t-0.25   0.5\t0.75",
            "a b.png;-0,25;0,5;0,75",
            "a b.png -0,25 0,5 0,75",
            "a b.png,-0.25,0.5,0.75",
            "a b.png, -0.25, 0.5, 0.75",
            "'a b.png' \u{2212}0.25 .5 7.5e-1;",
        ] {
            assert_eq!(
                line(text),
                Some((Some("a b.png".into()), light.clone())),
                "{text}"
            );
        }
        for text in [
            "-0.25 0.5 0.75",
            "-0,25;0,5;0,75",
            "-0.25,0.5,0.75",
            "-0,25 0,5 0,75",
        ] {
            assert_eq!(line(text), Some((None, light.clone())), "{text}");
        }
        assert_eq!(
            line("IMG 12 -0.25 0.5 0.75"),
            Some((Some("IMG 12".into()), light))
        );
        let colours = line("a 1.png 0 0 1 2 3 4").unwrap();
        assert_eq!(
            colours,
            (Some("a 1.png".into()), vec![0.0, 0.0, 1.0, 2.0, 3.0, 4.0])
        );
        assert_eq!(line("12"), Some((None, vec![12.0])));
        for text in [
            "x y z",
            "a b c d",
            "a.png 0 1",
            "1 2 3 4 5",
            "1 2 3 4 5 6 7 8",
        ] {
            assert_eq!(line(text), None, "{text}");
        }
    }
}
