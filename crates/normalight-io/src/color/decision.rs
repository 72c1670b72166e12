//! How the samples of a stack are taken, where files say nothing or contradict each other.
use super::ColorMode;
use super::evidence::{Evidence, of_stack};
use crate::Notice;
use crate::input_plan::{ColorDecision, ColorReason};
use normalight_core::{ImageStack, Mask, Samples, Transfer};

/// How sure the shading must be to be believed against what such files usually are. Of rendered
/// stacks in 8 bits, 34 of 100 linear ones are so found, and 5 of 100 encoded ones mistaken.
const DECIDES: f32 = 0.7;
/// The factor at which pixels that every lamp reaches are believed where the rest tells nothing.
/// Rendered stacks do not support it (2 of 100 linear ones found, 12 of 100 encoded ones mistaken,
/// nearly all of them glossy), photographs of benchmarks and the samples in 8 linear bits that
/// people exchange do; so it is said to be hardly better than a guess.
const LIT_DECIDES: f32 = 1.25;
/// How sure it must be to be said where something else was taken.
const CONTRADICTS: f32 = 0.85;

/// Sets the transfer of images that say nothing; `stated` is what each file says in words.
pub(crate) fn decide(
    stack: &mut ImageStack,
    mask: &Mask,
    stated: &[Option<String>],
    benchmark: bool,
    asked: ColorMode,
) -> (ColorDecision, Vec<Notice>) {
    let unstated: Vec<usize> = (0..stated.len()).filter(|&k| stated[k].is_none()).collect();
    let evidence = comparable(stack, stated)
        .then(|| of_stack(stack, mask))
        .flatten();
    let mut notices = Vec::new();
    let decided = (!unstated.is_empty()).then(|| {
        taken(
            stack,
            &unstated,
            evidence,
            benchmark && asked == ColorMode::Auto,
        )
    });
    if let Some((transfer, because)) = decided {
        for &image in &unstated {
            stack.set_transfer(image, transfer);
        }
        if because != ColorReason::Benchmark {
            notices.push(Notice::ColorUnstated {
                taken: word(transfer).to_owned(),
                sure: evidence
                    .filter(|_| because == ColorReason::Shading)
                    .map(Evidence::sure),
            });
        }
    }
    notices.extend(contradiction(stack, evidence));
    let said = said(stack, stated, decided.map(|(transfer, _)| transfer));
    if said.len() > 1 {
        let shown = said.iter().map(|(words, file)| format!("{file} {words}"));
        notices.push(Notice::ColorMixed {
            said: shown.collect(),
        });
    }
    let words: Vec<String> = said.into_iter().map(|(words, _)| words).collect();
    let color = ColorDecision {
        taken: words.join(" and "),
        because: match (asked, decided) {
            (ColorMode::Auto, Some((_, because))) => because,
            (ColorMode::Auto, None) => ColorReason::Stated,
            _ => ColorReason::Asked,
        },
    };
    (color, notices)
}

/// How images that say nothing are taken, and why.
///
/// Deep ones are linear: programs that write them for viewing add a profile. 8 bits are made for
/// viewing unless the shading says otherwise.
fn taken(
    stack: &ImageStack,
    unstated: &[usize],
    evidence: Option<Evidence>,
    benchmark: bool,
) -> (Transfer, ColorReason) {
    let is_8_bit = |&image: &usize| matches!(stack.images()[image].samples, Samples::U8(_));
    if benchmark {
        return (Transfer::Linear, ColorReason::Benchmark);
    }
    if !unstated.iter().all(is_8_bit) {
        return (Transfer::Linear, ColorReason::Usual);
    }
    let believed = |evidence: &Evidence| match evidence.agreed {
        true => evidence.sure() >= DECIDES,
        false => evidence.factor.max(1.0 / evidence.factor) >= LIT_DECIDES,
    };
    match evidence.filter(believed) {
        Some(evidence) => (evidence.looks(), ColorReason::Shading),
        None => (Transfer::Srgb, ColorReason::Usual),
    }
}

/// Whether the stored samples of all images relate to light in one way, which is one of the two that
/// can be told apart.
fn comparable(stack: &ImageStack, stated: &[Option<String>]) -> bool {
    let plain = |said: &Option<String>| match said.as_deref() {
        None => true,
        Some(words) => [Transfer::Linear, Transfer::Srgb]
            .map(word)
            .contains(&words),
    };
    stated.windows(2).all(|pair| pair[0] == pair[1])
        && stated.iter().all(plain)
        && (stack.images().iter()).all(|image| !matches!(image.samples, Samples::F32(_)))
}

/// Pixels that clearly look otherwise than they were taken.
fn contradiction(stack: &ImageStack, evidence: Option<Evidence>) -> Option<Notice> {
    let evidence = evidence.filter(|evidence| evidence.sure() >= CONTRADICTS)?;
    let (taken, looks) = (stack.images().first()?.transfer, evidence.looks());
    (taken != looks).then(|| Notice::LooksOtherwise {
        taken: word(taken).to_owned(),
        looks: word(looks).to_owned(),
        factor: evidence.factor.max(1.0 / evidence.factor),
        sure: evidence.sure(),
    })
}

/// The different words that the files say, sorted, each with the first file that does; `decided` is
/// for those that say nothing.
fn said(
    stack: &ImageStack,
    stated: &[Option<String>],
    decided: Option<Transfer>,
) -> Vec<(String, String)> {
    let mut said: Vec<(String, String)> = Vec::new();
    for (words, image) in stated.iter().zip(stack.images()) {
        let words = words.clone().or(decided.map(|t| word(t).to_owned()));
        let words = words.unwrap_or_default();
        if said.iter().all(|(other, _)| *other != words) {
            said.push((words, image.name.clone()));
        }
    }
    said.sort();
    said
}

fn word(transfer: Transfer) -> &'static str {
    match transfer {
        Transfer::Linear => "linear",
        Transfer::Srgb => "sRGB",
    }
}
