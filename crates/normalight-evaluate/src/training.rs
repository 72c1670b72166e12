use crate::EvaluateError;

/// The course of a training: what its folder's `curves.csv` says.
#[derive(Debug, Clone, PartialEq)]
pub struct Training {
    /// Its name in the report.
    pub name: String,
    /// Its validations, the first one first.
    pub points: Vec<TrainingPoint>,
}

/// A validation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrainingPoint {
    /// Steps so far.
    pub step: u64,
    /// Hours of training so far, validations left out.
    pub hours: f64,
    /// Error on unseen objects, in degrees.
    pub degrees: f64,
}

impl Training {
    /// From the text of `curves.csv`.
    ///
    /// # Errors
    /// [`EvaluateError::Curves`], with the training's name and the line.
    pub fn read(name: &str, csv: &str) -> Result<Self, EvaluateError> {
        let wrong = |line: usize, found: &str| EvaluateError::Curves {
            name: name.to_owned(),
            line,
            found: found.to_owned(),
        };
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .from_reader(csv.as_bytes());
        let heads = reader
            .headers()
            .map_err(|error| wrong(1, &error.to_string()))?
            .clone();
        let column = |head: &str| {
            let found = heads.iter().position(|one| one == head);
            found.ok_or_else(|| wrong(1, heads.as_slice()))
        };
        let (step, degrees, seconds) = (
            column("step")?,
            column("validation_degrees")?,
            column("seconds")?,
        );
        let mut points = Vec::new();
        for (place, record) in reader.records().enumerate() {
            let line = place + 2;
            let record = record.map_err(|error| wrong(line, &error.to_string()))?;
            let number = |column: usize| {
                let cell = record.get(column).unwrap_or_default();
                let number = cell.trim().parse::<f64>().ok();
                number
                    .filter(|number| number.is_finite() && *number >= 0.0)
                    .ok_or_else(|| wrong(line, cell))
            };
            points.push(TrainingPoint {
                step: number(step)? as u64,
                hours: number(seconds)? / 3600.0,
                degrees: number(degrees)?,
            });
        }
        if points.is_empty() {
            return Err(wrong(2, "no validation"));
        }
        Ok(Self {
            name: name.to_owned(),
            points,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_their_heads() {
        let csv = "step,loss,validation_degrees,learning_rate,seconds,intensity\n\
                   500,0.5,12.5,0.001,1800.0,0.1\n1000,0.4,11,0.0005,3600.0,0.09\n";
        let training = Training::read("paper", csv).unwrap();
        assert_eq!(training.name, "paper");
        let points: Vec<_> = training
            .points
            .iter()
            .map(|p| (p.step, p.hours, p.degrees))
            .collect();
        assert_eq!(points, [(500, 0.5, 12.5), (1000, 1.0, 11.0)]);
    }

    #[test]
    fn what_is_no_course_is_named_with_its_line() {
        let head = "step,validation_degrees,seconds\n";
        for (csv, line) in [
            (String::new(), 1),
            ("step,loss\n1,2\n".to_owned(), 1),
            (head.to_owned(), 2),
            (format!("{head}1,2,3\n1,NaN,3\n"), 3),
            (format!("{head}1,2\n"), 2),
        ] {
            let error = Training::read("run", &csv).unwrap_err();
            let EvaluateError::Curves { line: found, .. } = error else {
                panic!("{error}");
            };
            assert_eq!(found, line, "{csv:?}");
        }
    }
}
