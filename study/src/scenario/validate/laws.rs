//! `laws` of [campaign] and of [assess].

use super::Reader;
use crate::laws::{LawName, LawSet};
use crate::scenario::read::LawList;

impl Reader<'_> {
    /// The laws of a list, each once and none for which `refusal` has a reason; `default` if there is no list.
    pub(super) fn laws(
        &self,
        list: &LawList,
        default: LawSet,
        refusal: impl Fn(LawName) -> Option<&'static str>,
    ) -> Option<LawSet> {
        let Some(list) = list else {
            return Some(default);
        };
        self.not_empty(list, "laws = [\"eq16\", \"on_line\"]")?;
        let mut laws = LawSet::of(&[]);
        let mut sound = true;
        for item in &list.value {
            let Some(item) = item else {
                sound = false;
                continue;
            };
            let law = item.value;
            let (fault, label) = if let Some(reason) = refusal(law) {
                (format!("cannot be {:?}", law.name()), reason)
            } else if laws.contains(law) {
                (format!("is {:?} once more", law.name()), "")
            } else {
                laws = laws.with(law);
                continue;
            };
            sound = false;
            let free = LawName::ALL
                .into_iter()
                .filter(|law| refusal(*law).is_none());
            let names: Vec<_> = free.map(|law| format!("{:?}", law.name())).collect();
            let message = format!("{} {fault}", item.name);
            let help = format!("leave it out; there are {}", names.join(", "));
            self.refuse(&item.span, message, label, help);
        }
        sound.then_some(laws)
    }
}
