//! Does a batch with some program: `ROOT OUTPUT PROGRAM JOBS SHARD [ARGUMENTS...]`. Says each row.
use normalight_batch::{
    BatchObserver, BatchSettings, Capture, Outcome, Program, Progress, Row, run_batch,
};
use std::env::args_os;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

struct Say;

impl BatchObserver for Say {
    fn started(&mut self, capture: &Capture) {
        println!("started {}", capture.name());
    }

    fn finished(&mut self, row: &Row, progress: &Progress) {
        let words = match &row.outcome {
            Outcome::Failed(words) => words,
            _ => "",
        };
        println!(
            "{} {} ({} of {}, {:?} left) {words}",
            row.outcome.word(),
            row.capture,
            progress.done,
            progress.total,
            progress.left,
        );
    }

    fn noticed(&mut self, words: &str) {
        println!("notice: {words}");
    }
}

fn main() -> ExitCode {
    let mut arguments = args_os().skip(1);
    let mut next = || arguments.next().expect("ROOT OUTPUT PROGRAM JOBS SHARD");
    let number = |text: std::ffi::OsString| text.into_string().expect("text");
    let (root, output, program) = (next().into(), next().into(), next().into());
    let (jobs, shard) = (number(next()), number(next()));
    let settings = BatchSettings {
        root,
        output,
        program: Program {
            path: program,
            version: "test".to_owned(),
            arguments: arguments.collect(),
            files: Vec::new(),
            environment: Vec::new(),
        },
        jobs: jobs.parse().expect("a number of jobs"),
        memory: None,
        shard: shard.parse().expect("a shard"),
        time_limit: None,
        check_contents: false,
    };
    match run_batch(&settings, &AtomicBool::new(false), &mut Say) {
        Ok(summary) if summary.is_complete() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
