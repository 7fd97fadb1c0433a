//! Scenes whose data have one feature that fixed rules of a coarse mesh miss: narrow, stepped, unbounded, fading, cancelling.
//!
//! The other data are smooth, so that a mesh of a few lines resolves all of them: lines through steps, kinks and poles, and lines
//! that are graded to the middle of what is narrow, down to half of its width. What its own bound says then holds by any rule.

use std::f64::consts::PI;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use super::catalogue;
use super::cut::Line;
use super::mesh::{self, MeshPlan, Outline, Regions};
use super::posed::{Hold, Posed, turned};
use super::spot::{NAMES, SIDES, Side, Spot, shape};
use crate::extremes::solution::Solution;
use signorini_problem::random::Random;
use signorini_scene::Mesh;

/// A feature of the data of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
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
    /// A step or a bump of what the transfer is to.
    Ambient,
    /// A bump of the gap, or a hat.
    Gap,
    /// A bump of u_D, or a hat.
    Value,
}

/// Draws a scene, and the lines of a mesh that resolves its data.
pub(super) fn draw(random: &mut Random, plan: &MeshPlan, feature: Feature) -> (Posed, Vec<Line>) {
    let cells = plan.cells.min(200);
    let (outline, regions) = (Outline::Whole, Regions::Halves);
    let plan = MeshPlan { cells, outline, regions, split: false, ..*plan };
    if feature == Feature::Cancellation {
        let contrast = random.log(1e6, 1e9);
        let jump = Solution::Jump(random.pick(&[contrast, 1.0 / contrast]));
        return (catalogue::posed(random, &plan, jump), Vec::new());
    }
    let mesh = mesh::draw(random, &plan).mesh;
    let mut data = Data::draw(random);
    let width = (2.0 / mesh.cells() as f64).sqrt() * random.log(1e-4, 3.0);
    let spot = match feature {
        Feature::Transfer | Feature::Ambient => data.narrow(random, feature, 1, width),
        Feature::Flux => data.narrow(random, feature, 2, width),
        Feature::ContactFlux => data.narrow(random, feature, 0, width),
        Feature::Gap => data.raised(random, feature, 0, width),
        Feature::Value => data.raised(random, feature, 3, width),
        Feature::FadingLimit | Feature::Kink => data.bent(random, feature, &mesh, width),
        Feature::Offset | Feature::Anisotropy => data.large(random, feature),
        _ => data.inside(random, feature, width),
    };
    (Posed { scene: data.scene(), mesh, hold: Hold::Dirichlet, inputs: Vec::new() }, spot.lines())
}

/// The data of a scene: contact on one side, then a transfer law, a given flux and given values.
struct Data {
    turn: usize,
    tensor: [String; 3],
    source: String,
    gap: String,
    fluxes: [String; 2],
    transfer: [String; 2],
    flux: String,
    value: String,
}

impl Data {
    /// Smooth data; gap ≤ 0 ≤ value.
    fn draw(random: &mut Random) -> Self {
        let (turn, size) = (random.below(4) as usize, random.log(0.1, 10.0));
        let mut number = |low: f64, high: f64| format!("{:e}", random.between(low, high));
        let along = NAMES[SIDES[turn].1];
        Self {
            turn,
            tensor: [format!("{size:e}"), number(-0.05, 0.05), number(0.1, 2.0)],
            source: number(-1.0, 1.0),
            gap: format!("{}-{}*{along}^2", number(-0.5, 0.0), number(0.0, 0.5)),
            fluxes: ["0", "inf"].map(str::to_owned),
            transfer: [number(0.1, 5.0), number(-3.0, 3.0)],
            flux: number(-2.0, 1.0),
            value: format!("{}*({along}+1)", number(0.0, 1.0)),
        }
    }

    /// The side of a role: contact, transfer, given flux, given values.
    fn side(&self, role: usize) -> Side {
        SIDES[(self.turn + role) % 4]
    }

    /// A step or a bump of what is given on a side.
    fn narrow(&mut self, random: &mut Random, feature: Feature, role: usize, width: f64) -> Spot {
        let side @ (_, axis, [low, high], other) = self.side(role);
        let spot = Spot::on(side, random.between(low, high), other, width);
        let shape = shape(random, &spot.square(&[axis]));
        let (most, size) = (random.log(1.0, 1e3) / width, random.signed_log(0.1, 3.0) / width);
        match feature {
            Feature::Transfer => self.transfer[0] += &format!("*(1+{most:e}*{shape})"),
            Feature::Ambient => self.transfer[1] += &format!("+{size:e}*{shape}"),
            Feature::Flux => self.flux = format!("{size:e}*{shape}"),
            _ => self.fluxes[0] = format!("{size:e}*{shape}"),
        }
        spot
    }

    /// A bump or a hat of the gap or of u_D, down or up: gap ≤ 0 ≤ value.
    fn raised(&mut self, random: &mut Random, feature: Feature, role: usize, width: f64) -> Spot {
        let side @ (_, axis, [low, high], other) = self.side(role);
        let (at, size) = (random.between(low, high), random.log(0.1, 10.0));
        let spot = Spot::on(side, at, other, width);
        let shape = match random.chance(0.5) {
            true => format!("exp(-{})", spot.square(&[axis])),
            false => format!("max(0, 1-abs({}-{at:e})/{width:e})", NAMES[axis]),
        };
        let is_up = random.chance(0.5);
        let (text, lower) = match feature {
            Feature::Gap => (&mut self.gap, is_up),
            _ => (&mut self.value, !is_up),
        };
        let level = match (lower, is_up) {
            (true, true) => -size,
            (true, false) => size,
            (false, _) => 0.0,
        };
        let signed = if is_up { size } else { -size };
        *text += &format!("+{level:e}+{signed:e}*{shape}");
        spot
    }

    /// A strip of other conductivity, or a source that is narrow or a power of the distance.
    fn inside(&mut self, random: &mut Random, feature: Feature, width: f64) -> Spot {
        let is_strip = feature != Feature::Power && random.chance(0.5);
        let spot = Spot::inside(random, width, is_strip || feature == Feature::Conductivity);
        let (square, size) = (spot.square(&[0, 1]), random.signed_log(0.1, 3.0));
        if feature == Feature::Conductivity {
            let (shape, most) = (shape(random, &square), random.log(1.0, 1e3) / width);
            if random.chance(0.3) {
                self.turn_tensor(random, &shape);
                return spot;
            }
            let sign = random.pick(&["*", "/"]);
            self.tensor.iter_mut().for_each(|of| *of += &format!("{sign}(1+{most:e}*{shape})"));
            return spot;
        }
        let power = -random.log(0.01, 0.99);
        self.source = match (feature, is_strip) {
            (Feature::Power, _) => {
                format!("{:e}*{square}^{:e}", size * width.powf(power), 0.5 * power)
            }
            (_, true) => format!("{:e}*exp(-{square})", size / width),
            (_, false) => format!("{:e}*exp(-{square})", size / width.powi(2)),
        };
        spot
    }

    /// A goes from diag(p, q) to that of any other axes.
    fn turn_tensor(&mut self, random: &mut Random, shape: &str) {
        let [p, q, r, s] = [0; 4].map(|_| random.log(0.1, 100.0));
        let other = turned([r, s], random.between(0.0, PI).sin_cos());
        let from = [p, 0.0, q];
        self.tensor = [0, 1, 2].map(|k| format!("{:e}+{:e}*{shape}", from[k], other[k] - from[k]));
    }

    /// A large constant of u, or a large anisotropy and a wave across it.
    fn large(&mut self, random: &mut Random, feature: Feature) -> Spot {
        if feature == Feature::Offset {
            let by = random.signed_log(1e2, 1e4);
            let [_, ambient] = &mut self.transfer;
            for text in [&mut self.gap, ambient, &mut self.value] {
                *text += &format!("+{by:e}");
            }
        } else {
            let (p, steep) = (random.log(1.0, 1e6), random.log(1.0, 20.0));
            let angle = [0.0, 0.5 * PI, random.between(0.0, PI)];
            let (sin, cos) = random.pick(&angle).sin_cos();
            let tensor =
                [1.0 + (p - 1.0) * cos * cos, (p - 1.0) * sin * cos, 1.0 + (p - 1.0) * sin * sin];
            self.tensor = tensor.map(|entry| format!("{entry:e}"));
            self.source = format!("{p:e}*sin({:e}*x+{:e}*y)", steep * cos, steep * sin);
        }
        Spot::inside(random, 0.5, true)
    }

    /// A limit that fades to 0 at an end of its side or inside, or a kink of the gap, maybe right beside a vertex.
    fn bent(&mut self, random: &mut Random, feature: Feature, mesh: &Mesh, width: f64) -> Spot {
        let side @ (_, axis, ends @ [low, high], other) = self.side(0);
        let of_side = mesh.vertices.iter().filter(|vertex| vertex[1 - axis] == other);
        let places: Vec<f64> = of_side.map(|vertex| vertex[axis]).collect();
        let at = match (random.chance(0.5), feature) {
            (true, Feature::FadingLimit) => random.pick(&ends),
            (true, _) => random.pick(&places) + random.signed_log(1e-13, 1e-11),
            _ => random.between(low, high),
        };
        let (name, size, sign) = (NAMES[axis], random.log(0.1, 10.0), random.pick(&["", "-"]));
        if feature == Feature::FadingLimit {
            let least = format!("{:e}", random.between(-1.0, 1.0));
            self.fluxes =
                [least.clone(), format!("{least}+{size:e}*max(0, {sign}({name}-{at:e}))")];
        } else {
            self.gap = format!("-0.5+{sign}{:e}*abs({name}-{at:e})", 0.025 * size);
        }
        Spot::on(side, at, other, width)
    }

    fn scene(&self) -> String {
        let Self { source, gap, fluxes: [least, limit], transfer: [h, ambient], .. } = self;
        let (Self { flux, value, .. }, [xx, xy, yy]) = (self, &self.tensor);
        let [contact, robin, neumann, dirichlet] = [0, 1, 2, 3].map(|role| self.side(role).0);
        format!(
            r#"title = "random"
mesh = "mesh.msh"
material.default.conductivity = ["{xx}", "{xy}", "{yy}"]
source.f = "{source}"
[boundary]
{contact} = {{ kind = "contact", gap = "{gap}", flux = "{least}", limit = "{limit}" }}
{robin} = {{ kind = "robin", coefficient = "{h}", ambient = "{ambient}" }}
{neumann} = {{ kind = "neumann", flux = "{flux}" }}
{dirichlet} = {{ kind = "dirichlet", value = "{value}" }}
"#
        )
    }
}
