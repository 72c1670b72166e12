//! A job ends with its batch, however that ends.
use std::io::Read;

/// Variable of the environment that a job finds set.
pub const JOB_VARIABLE: &str = "NORMALIGHT_BATCH_JOB";

/// For the program that does a job, as the first thing: where it was called by a batch, it ends as soon as the batch does.
///
/// A batch holds the other end of each job's standard input and never writes into it. The system closes it when the batch
/// ends, by whatever signal, on every system; nothing else ends processes with their parent everywhere. A job that
/// does not call this goes on for a while, into a folder which is not there any more, and does no harm but its work.
pub fn end_with_batch() {
    if std::env::var_os(JOB_VARIABLE).is_none() {
        return;
    }
    std::thread::spawn(|| {
        let mut byte = [0; 1];
        let mut end = std::io::stdin().lock();
        // Whatever stands there: what counts is the end.
        while matches!(end.read(&mut byte), Ok(count) if count > 0) {}
        std::process::exit(ENDED);
    });
}

/// What a job ends with whose batch is no more: nobody sees it.
const ENDED: i32 = 130;
