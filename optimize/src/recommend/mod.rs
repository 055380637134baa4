//! From modes with their uncertainty to the move or the shaper to use.

mod error;
mod motion;
mod moves;
mod region;
mod shapers;

pub use error::RecommendError;
pub use motion::{Motion, MoveKind};
pub use moves::{JudgedMove, MoveRecommendation, MoveTask, recommend_move};
pub use region::UncertainMode;
pub use shapers::{
    CAPACITY as SHAPER_CAPACITY, JudgedShaper, ShaperRecommendation, recommend_shaper, shaper_name,
};
