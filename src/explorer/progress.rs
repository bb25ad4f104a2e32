//! How the answers to predictions went, over all sessions: kept in the folder for state, never in a scene.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::door::Expected;
use crate::explain::{Judgement, StepQuestion};
use crate::explorer::files::kept;
use crate::explorer::state::State;

/// What a file of progress is read within.
const PROGRESS: Expected = Expected {
    what: "the progress of predictions",
    most: 1 << 16,
};

/// Counts of answers.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
struct Progress {
    /// How often each question was answered.
    asked: BTreeMap<String, u32>,
    /// How often rightly at once.
    right: BTreeMap<String, u32>,
    /// How often by each known slip.
    slips: BTreeMap<String, u32>,
}

fn file(state: &State) -> Option<PathBuf> {
    state.workplace.progress_file()
}

/// What was kept; nothing where there is nothing, or nothing that can be read.
fn read(state: &State) -> Progress {
    let text = file(state).and_then(|path| PROGRESS.text(&path).ok());
    text.and_then(|text| serde_json::from_str(&text).ok())
        .unwrap_or_default()
}

/// Notes the first answer to a question.
pub(crate) fn note(state: &State, question: StepQuestion, judgement: Judgement) {
    let Some(path) = file(state) else {
        return;
    };
    let mut progress = read(state);
    let count = |counts: &mut BTreeMap<String, u32>, name: &str| {
        let count = counts.entry(name.to_owned()).or_default();
        *count = count.saturating_add(1);
    };
    count(&mut progress.asked, question.name());
    match judgement {
        Judgement::Right => count(&mut progress.right, question.name()),
        Judgement::Slip(slip) => count(&mut progress.slips, slip.name()),
        Judgement::Wrong => {}
    }
    // A lesson goes on where nothing can be kept.
    if let Ok(text) = serde_json::to_string_pretty(&progress) {
        let _ = kept::write_private(&path, &text);
    }
}

/// How it went so far, in a sentence; nothing before the first answer.
pub(crate) fn sentence(state: &State) -> String {
    let Progress {
        asked,
        right,
        slips,
    } = read(state);
    let sum = |counts: &BTreeMap<String, u32>| counts.values().map(|&n| u64::from(n)).sum::<u64>();
    if sum(&asked) == 0 {
        return String::new();
    }
    let most = slips.iter().max_by_key(|(_, n)| **n);
    let most = most.map_or(String::new(), |(name, n)| format!(", {name} {n} times"));
    format!(
        "So far: {} of {} right at the first try{most}.",
        sum(&right),
        sum(&asked)
    )
}
