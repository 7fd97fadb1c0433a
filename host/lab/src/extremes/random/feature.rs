//! Scenes whose data have one feature that fixed rules of a coarse mesh miss: narrow, stepped, unbounded, fading, cancelling.
//!
//! The other data are smooth, so that a mesh of a few lines resolves all of them: lines through steps, kinks and poles, and lines
//! that are graded to the middle of what is narrow, down to half of its width. What its own bound says then holds by any rule.

use std::fmt::Write;

use serde::Serialize;

use super::catalogue;
use super::cut::Line;
use super::mesh::{self, MeshPlan, Outline, Regions};
use super::posed::{Hold, Posed};
use crate::extremes::solution::Solution;
use signorini_problem::random::Random;
use signorini_scene::mesh::Mesh;

/// What the data of a scene have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// A Gaussian bump of f.
    Source,
    /// A step or a bump of a given flux.
    Flux,
    /// A step or a bump of the least flux of contact.
    ContactFlux,
    /// f = r^(a − 2) with a > 1.
    Power,
    /// A contrast of 1e6 to 1e9 beside an exact u_D.
    Cancellation,
    /// A constant of 1e3 ranges in all data of u.
    Offset,
    /// An anisotropy up to 1e6, oblique or not, and a wave of f.
    Anisotropy,
    /// A limit of the flux that fades to 0.
    FadingLimit,
    /// A kink of the gap, in half of all scenes 1e−12 beside a vertex.
    Kink,
    /// A step or a bump of A.
    Conductivity,
    /// A step or a bump of a transfer coefficient.
    Transfer,
}

impl Feature {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Source,
        Self::Flux,
        Self::ContactFlux,
        Self::Power,
        Self::Cancellation,
        Self::Offset,
        Self::Anisotropy,
        Self::FadingLimit,
        Self::Kink,
        Self::Conductivity,
        Self::Transfer,
    ];
}

/// Draws a scene, and the lines of a mesh that resolves its data.
pub(super) fn draw(random: &mut Random, plan: &MeshPlan, feature: Feature) -> (Posed, Vec<Line>) {
    let whole = (Outline::Whole, Regions::Halves, false);
    let cells = plan.cells.min(200);
    let plan = MeshPlan { cells, outline: whole.0, regions: whole.1, split: whole.2, ..*plan };
    if feature == Feature::Cancellation {
        let contrast = random.log(1e6, 1e9);
        let jump = Solution::Jump(random.pick(&[contrast, 1.0 / contrast]));
        return (catalogue::posed(random, &plan, jump), Vec::new());
    }
    let mesh = mesh::draw(random, &plan).mesh;
    let turn = random.below(4) as usize;
    let mut data = Data::draw(random, turn);
    let spot = data.add(random, feature, &mesh);
    let (scene, hold, inputs) = (data.scene(&mesh), Hold::Dirichlet, Vec::new());
    (Posed { scene, mesh, hold, inputs }, spot.lines())
}

/// A side of (−1, 1) × (0, 1): its name, the coordinate along it with its ends, and the value of the other.
const SIDES: [(&str, usize, [f64; 2], f64); 4] = [
    ("bottom", 0, [-1.0, 1.0], 0.0),
    ("right", 1, [0.0, 1.0], 1.0),
    ("top", 0, [-1.0, 1.0], 1.0),
    ("left", 1, [0.0, 1.0], -1.0),
];
const NAMES: [&str; 2] = ["x", "y"];

/// The place of a feature: its middle, in one coordinate where it is a strip, and half of its width.
#[derive(Debug, Clone, Copy)]
struct Spot {
    middle: [Option<f64>; 2],
    width: f64,
}

impl Spot {
    /// On a side.
    fn on(
        random: &mut Random,
        (_, axis, [low, high], other): (&str, usize, [f64; 2], f64),
        width: f64,
    ) -> Self {
        let mut middle = [Some(other); 2];
        middle[axis] = Some(random.between(low, high));
        Self { middle, width }
    }

    /// Inside: a point, or a strip along the other coordinate.
    fn inside(random: &mut Random, width: f64, strip: bool) -> Self {
        let mut middle = [Some(random.between(-1.0, 1.0)), Some(random.between(0.0, 1.0))];
        if strip {
            middle[random.below(2) as usize] = None;
        }
        Self { middle, width }
    }

    /// The square of the distance to its middle over its width, along `axis` or at all.
    fn square(&self, axes: &[usize]) -> String {
        let of = |&axis: &usize| {
            Some(format!("(({} - {:e})/{:e})^2", NAMES[axis], self.middle[axis]?, self.width))
        };
        format!("({})", axes.iter().filter_map(of).collect::<Vec<_>>().join(" + "))
    }

    /// Lines through its middle, and graded to it.
    fn lines(&self) -> Vec<Line> {
        let mut factors = vec![0.5, 1.0, 1.5, 2.0, 3.0];
        while let Some(last) = factors.last().filter(|last| *last * self.width < 2.0) {
            factors.push(3.0 * last);
        }
        let both = factors.iter().flat_map(|factor| [-factor, *factor]);
        let all: Vec<f64> = both.chain([0.0]).map(|factor| factor * self.width).collect();
        let of = |axis: usize| self.middle[axis].map(|middle| (axis, middle));
        let on = |(axis, middle): (usize, f64)| {
            all.iter().map(move |off| Line { axis, at: middle + off })
        };
        [0, 1].into_iter().filter_map(of).flat_map(on).collect()
    }
}

/// 1 within a width, else 0; or exp of what is in `square`.
fn shape(random: &mut Random, square: &str) -> String {
    match random.chance(0.5) {
        true => format!("(0.5+0.5*sign(1-{square}))"),
        false => format!("exp(-{square})"),
    }
}

/// The data of a scene: contact on one side, then a transfer law, a given flux and given values.
struct Data {
    turn: usize,
    tensor: [String; 3],
    source: String,
    gap: String,
    least: String,
    limit: String,
    coefficient: String,
    ambient: String,
    flux: String,
    value: String,
}

impl Data {
    /// Smooth data; gap ≤ 0 ≤ value.
    fn draw(random: &mut Random, turn: usize) -> Self {
        let size = random.log(0.1, 10.0);
        let mut number = |low: f64, high: f64| format!("{:e}", random.between(low, high));
        let along = NAMES[SIDES[turn].1];
        Self {
            turn,
            tensor: [format!("{size:e}"), number(-0.05, 0.05), number(0.1, 2.0)],
            source: number(-1.0, 1.0),
            gap: format!("{}-{}*{along}^2", number(-0.5, 0.0), number(0.0, 0.5)),
            least: "0".to_owned(),
            limit: "inf".to_owned(),
            coefficient: number(0.1, 5.0),
            ambient: number(-3.0, 3.0),
            flux: number(-2.0, 1.0),
            value: format!("{}*({along}+1)", number(0.0, 1.0)),
        }
    }

    /// Side `role` of contact, transfer, given flux and given values.
    fn side(&self, role: usize) -> (&'static str, usize, [f64; 2], f64) {
        SIDES[(self.turn + role) % 4]
    }

    /// Adds the feature; returns its place.
    fn add(&mut self, random: &mut Random, feature: Feature, mesh: &Mesh) -> Spot {
        let cell = (2.0 / mesh.cells() as f64).sqrt();
        let width = cell * random.log(1e-4, 3.0);
        match feature {
            Feature::Conductivity => self.conductivity(random, width),
            Feature::Transfer => {
                let (spot, shape) = self.narrow(random, 1, width);
                let _ = write!(self.coefficient, "*(1+{:e}*{shape})", random.log(1.0, 1e3) / width);
                spot
            }
            Feature::Flux => {
                let (spot, shape) = self.narrow(random, 2, width);
                self.flux = format!("{:e}*{shape}", random.signed_log(0.1, 3.0) / width);
                spot
            }
            Feature::ContactFlux => {
                let (spot, shape) = self.narrow(random, 0, width);
                self.least = format!("{:e}*{shape}", random.signed_log(0.1, 3.0) / width);
                spot
            }
            Feature::Source | Feature::Power => self.source(random, feature, width),
            Feature::Offset => self.offset(random, width),
            Feature::Anisotropy => self.anisotropy(random),
            Feature::FadingLimit => self.fading(random, width),
            Feature::Kink | Feature::Cancellation => self.kink(random, mesh, width),
        }
    }

    /// A step or a bump on the side of a role.
    fn narrow(&self, random: &mut Random, role: usize, width: f64) -> (Spot, String) {
        let side = self.side(role);
        let spot = Spot::on(random, side, width);
        let shape = shape(random, &spot.square(&[side.1]));
        (spot, shape)
    }

    /// A strip of other conductivity.
    fn conductivity(&mut self, random: &mut Random, width: f64) -> Spot {
        let spot = Spot::inside(random, width, true);
        let shape = shape(random, &spot.square(&[0, 1]));
        let (sign, most) = (random.pick(&["*", "/"]), random.log(1.0, 1e3) / width);
        for entry in &mut self.tensor {
            let _ = write!(entry, "{sign}(1+{most:e}*{shape})");
        }
        spot
    }

    fn source(&mut self, random: &mut Random, feature: Feature, width: f64) -> Spot {
        let strip = feature == Feature::Source && random.chance(0.5);
        let spot = Spot::inside(random, width, strip);
        let (square, size) = (spot.square(&[0, 1]), random.signed_log(0.1, 3.0));
        self.source = match feature {
            Feature::Power => {
                let power = random.between(1.01, 2.0) - 2.0;
                format!("{:e}*{square}^{:e}", size * width.powf(power), 0.5 * power)
            }
            _ => format!("{:e}*exp(-{square})", size / if strip { width } else { width * width }),
        };
        spot
    }

    fn offset(&mut self, random: &mut Random, width: f64) -> Spot {
        let by = random.signed_log(1e2, 1e4);
        for text in [&mut self.gap, &mut self.ambient, &mut self.value] {
            let _ = write!(text, "+{by:e}");
        }
        Spot::inside(random, width.max(0.1), true)
    }

    fn anisotropy(&mut self, random: &mut Random) -> Spot {
        let ratio = random.log(1.0, 1e6);
        let angle = random.pick(&[0.0, 0.5]) * std::f64::consts::PI;
        let angle = if random.chance(0.5) { angle } else { random.between(0.0, 3.1) };
        let (sin, cos) = angle.sin_cos();
        let entries = [
            cos * cos * ratio + sin * sin,
            (ratio - 1.0) * sin * cos,
            sin * sin * ratio + cos * cos,
        ];
        self.tensor = entries.map(|entry| format!("{entry:e}"));
        let steep = random.log(1.0, 20.0);
        self.source = format!("{ratio:e}*sin({:e}*x+{:e}*y)", steep * cos, steep * sin);
        Spot::inside(random, 0.5, true)
    }

    /// To 0 at an end of the side, or inside it.
    fn fading(&mut self, random: &mut Random, width: f64) -> Spot {
        let side = self.side(0);
        let mut spot = Spot::on(random, side, width);
        if random.chance(0.5) {
            spot.middle[side.1] = Some(random.pick(&side.2));
        }
        let (sign, from) = (random.pick(&["", "-"]), spot.middle[side.1].unwrap_or(0.0));
        self.least = format!("{:e}", random.between(-1.0, 1.0));
        let slope = random.log(0.1, 10.0);
        self.limit = format!("{}+{slope:e}*max(0, {sign}({}-{from:e}))", self.least, NAMES[side.1]);
        spot
    }

    fn kink(&mut self, random: &mut Random, mesh: &Mesh, width: f64) -> Spot {
        let side = self.side(0);
        let mut spot = Spot::on(random, side, width);
        let on_side = mesh.vertices.iter().filter(|vertex| vertex[1 - side.1] == side.3);
        let places: Vec<f64> = on_side.map(|vertex| vertex[side.1]).collect();
        if random.chance(0.5) {
            spot.middle[side.1] = Some(random.pick(&places) + random.signed_log(1e-13, 1e-11));
        }
        let middle = spot.middle[side.1].unwrap_or(0.0);
        self.gap =
            format!("-0.5+{:e}*abs({}-{middle:e})", random.between(-0.25, 0.25), NAMES[side.1]);
        spot
    }

    fn scene(&self, mesh: &Mesh) -> String {
        let mut text = String::from("title = \"random\"\nmesh = \"mesh.msh\"\n");
        for surface in &mesh.surfaces {
            let entries = self.tensor.each_ref().map(|entry| format!("\"{entry}\"")).join(", ");
            let _ = writeln!(text, "[material.{}]\nconductivity = [{entries}]", surface.name);
        }
        let _ = writeln!(text, "[source]\nf = \"{}\"", self.source);
        let Self { gap, least, limit, coefficient, ambient, flux, value, .. } = self;
        let bodies = [
            format!("kind = \"contact\"\ngap = \"{gap}\"\nflux = \"{least}\"\nlimit = \"{limit}\""),
            format!("kind = \"robin\"\ncoefficient = \"{coefficient}\"\nambient = \"{ambient}\""),
            format!("kind = \"neumann\"\nflux = \"{flux}\""),
            format!("kind = \"dirichlet\"\nvalue = \"{value}\""),
        ];
        for (role, body) in bodies.iter().enumerate() {
            let _ = writeln!(text, "[boundary.{}]\n{body}", self.side(role).0);
        }
        text
    }
}
