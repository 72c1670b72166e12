/// How lights get better once there are first normals; the normals are then estimated again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SecondPass {
    /// A guided light network looks again, with normals and lights in view.
    Guided,
    /// Each light moves towards the one that explains its photograph best with these normals.
    Refit,
}

impl SecondPass {
    /// The word of reports for what was done.
    pub fn name(pass: Option<Self>) -> &'static str {
        match pass {
            None => "none",
            Some(Self::Guided) => "guided",
            Some(Self::Refit) => "refit",
        }
    }

    /// Where estimated lights come from, for people.
    pub fn words(pass: Option<Self>) -> &'static str {
        match pass {
            None => "estimated by the light network",
            Some(Self::Guided) => {
                "estimated by the light network, and once more with the normals in view"
            }
            Some(Self::Refit) => "estimated by the light network, refitted to the normals",
        }
    }
}
