//! Everything of a baked scene, owned: what the module's statics will hold.

use std::collections::HashMap;

use signorini_bound::cells::{Cells, Quad, Triangle};
use signorini_bound::certificate::{Above, Discretization, Factor, Metric, POINTS, Stability};
use signorini_device::tick::Limits;
use signorini_kernel::Tensor;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::stiffness::Stiffness;

use super::data::{Data, refuse_faint};
use super::factored::Factored;
use super::options::TickOptions;
use super::output::{Output, output};
use super::storing::Stored;
use crate::Bakes;
use crate::module_api::ModuleApi;
use crate::setting::checked;
use signorini_certify::reach::Reach;
use signorini_certify::term::full_terms;
use signorini_certify::{Certifier, NoBound};
use signorini_problem::functional::functionals;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;
use signorini_scene::scene::units::Units;
use signorini_scene::setting::Method;
use signorini_solve::unfit;

/// A scene as the full model takes it, in the scalar `R`.
#[derive(Debug, Clone)]
pub struct Baked<R: Scalar> {
    /// Names, meanings, outputs.
    pub face: ModuleApi,
    pub(super) counts: EdgeCounts,
    pub(super) vertices: Vec<[R; 2]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) quads: Vec<[u32; 4]>,
    pub(super) of_triangles: Vec<[u32; 3]>,
    pub(super) of_quads: Vec<[u32; 4]>,
    pub(super) half_edges: Vec<[u32; 2]>,
    pub(super) stiffness_of_triangles: Vec<[R; 3]>,
    pub(super) stiffness_of_quads: Vec<[R; 6]>,
    pub(super) packed_triangles: Vec<Triangle<R, u32>>,
    pub(super) packed_quads: Vec<Quad<R, u32>>,
    pub(super) vertex_weights: Vec<R>,
    pub(super) edge_weights: Vec<R>,
    pub(super) order: Vec<u32>,
    pub(super) metric: Vec<[Tensor<R>; POINTS * POINTS]>,
    pub(super) factors: Vec<Factor<R>>,
    pub(super) above: Vec<Above<R>>,
    pub(super) missed: R,
    pub(super) metric_place: Vec<u32>,
    pub(super) distortions: Vec<[R; 2]>,
    pub(super) stability: Stability<R>,
    pub(super) data: Data<R>,
    pub(super) outputs: Vec<Output<R>>,
    pub(super) corners: Vec<[u32; 2]>,
    pub(super) start: R,
    pub(super) how: TickOptions<R>,
    /// The units of the numbers above, where they are not the scene's.
    pub(super) scale: Option<Units>,
    pub(super) factored: Option<Factored<R>>,
    /// Rows that inputs without a range have to meet.
    pub(super) exclusions: Vec<R>,
    /// Where ticks are steps in time.
    pub(super) stored: Option<Stored<R>>,
}

impl<R: Bakes> Baked<R> {
    /// Whether a cell has four sides.
    pub fn has_quads(&self) -> bool {
        !self.of_quads.is_empty()
    }

    /// Triangles and quads in which A in reference coordinates varies.
    pub fn varying(&self) -> [usize; 2] {
        let (triangles, quads) =
            self.metric_place.split_at(self.of_triangles.len().min(self.metric_place.len()));
        let varies = |place: &&u32| (**place as usize) < self.metric.len() + self.factors.len();
        [triangles, quads].map(|places| places.iter().filter(varies).count())
    }

    /// Whether these data allow for an error bound.
    pub fn has_bound(&self) -> bool {
        self.how.certified && self.no_bound().is_none()
    }

    /// Why its data allow for none.
    pub fn no_bound(&self) -> Option<&NoBound> {
        self.data.no_bound.as_ref()
    }

    /// The limits of its ticks.
    pub fn limits(&self) -> Limits<R> {
        self.how.limits
    }

    /// Entries of the factor that solves its ticks, if one does.
    pub fn entries(&self) -> Option<usize> {
        self.factored.as_ref().map(Factored::entries)
    }

    /// Whether its ticks have a certificate.
    pub fn is_certified(&self) -> bool {
        self.how.certified
    }

    /// The same in the units that `problem` is in.
    pub(super) fn in_its_units(problem: &Problem, face: ModuleApi) -> Result<Self> {
        let setting = checked::<R>(&problem.scene)?;
        Approach::FullModel.check(problem)?;
        Parts::examine(problem)?;
        let held = Parts::whatever_inputs(problem)?;
        let unfit = unfit::<R>(&problem.scene);
        // The ways out lead where something passes whatever the inputs.
        let least = problem.at_least_transfer()?;
        let assembled = Assembled::<R>::new(&least).map_err(&unfit)?;
        assembled.system().map_err(&unfit)?;
        let certifier = Certifier::new(&least, &held, &assembled).map_err(&unfit)?;
        let discretization = certifier.discretization(&assembled).map_err(&unfit)?;
        let outputs = functionals(problem)?.iter().map(|of| output(problem, of)).collect();
        // Where it is infinite so is the kernel's allowance for rounding.
        let largest = Some(discretization.stability.largest.wide()).filter(|way| way.is_finite());
        let reach = Reach::new(&least, largest.unwrap_or_default(), !certifier.hands_on());
        let terms = full_terms(problem)?;
        let mut data = Data::new(problem, &terms, discretization.stiffness, (&least, &reach))?;
        if problem.loads.step.is_some() && data.is_curved() {
            data.no_bound = data.no_bound.or_else(|| Some(NoBound::curved_in_step()));
        }
        data.check().map_err(&unfit)?;
        refuse_faint(&problem.scene, &data)?;
        let stored = Stored::new(problem, (&certifier, &assembled), &setting)?;
        let data = if setting.certificate { data } else { data.without_bound() };
        let start = assembled.start().first().copied().unwrap_or(R::ZERO);
        let mut how = TickOptions::new(&setting, problem.topology.counts.unknowns());
        // What starts cold in a step are its sweeps alone.
        how.cold &= stored.is_none();
        let corners = if how.certified { corners(problem) } else { Vec::new() };
        let baked =
            Self { start, outputs, corners, stored, ..Self::of(face, data, &discretization, how) };
        match setting.solver {
            Some(Method::Factor) => baked.with_factor(problem),
            _ => Ok(baked),
        }
    }

    fn of(
        face: ModuleApi,
        data: Data<R>,
        discretization: &Discretization<R, u32>,
        how: TickOptions<R>,
    ) -> Self {
        let Discretization { mesh, edges, stiffness, cells, metric, stability } = discretization;
        let [vertex_weights, edge_weights] = cells.weights();
        let varies = how.certified && !(metric.at_points.is_empty() && metric.factors.is_empty());
        // Which kind of cell comes next: where all of them are triangles with constant A nobody asks.
        let needs_order = how.certified && (varies || !cells.quads().is_empty());
        Self {
            face,
            counts: edges.counts(),
            vertices: kept(mesh.vertices(), how.certified),
            triangles: kept(mesh.triangles(), how.certified),
            quads: kept(mesh.quads(), how.certified),
            of_triangles: edges.of_triangles().to_vec(),
            of_quads: edges.of_quads().to_vec(),
            half_edges: edges.half_edges().to_vec(),
            stiffness_of_triangles: stiffness.triangles.to_vec(),
            stiffness_of_quads: stiffness.quads.to_vec(),
            packed_triangles: kept(cells.triangles(), how.certified),
            packed_quads: kept(cells.quads(), how.certified),
            vertex_weights: kept(vertex_weights, how.certified),
            edge_weights: kept(edge_weights, how.certified),
            order: kept(cells.order(), needs_order),
            metric: kept(metric.at_points, varies),
            factors: kept(metric.factors, varies),
            above: kept(metric.above, varies),
            missed: metric.missed,
            metric_place: kept(metric.place, varies),
            distortions: kept(metric.distortions, how.certified),
            stability: *stability,
            data,
            outputs: Vec::new(),
            corners: Vec::new(),
            start: R::ZERO,
            how,
            scale: None,
            factored: None,
            exclusions: Vec::new(),
            stored: None,
        }
    }

    /// What the certificate and the rows stand on.
    pub(super) fn discretization(&self) -> Discretization<'_, R, u32> {
        let (of_triangles, of_quads) = (&self.of_triangles, &self.of_quads);
        Discretization {
            mesh: Mesh::baked(&self.vertices, &self.triangles, &self.quads),
            edges: Edges::baked(of_triangles, of_quads, &self.half_edges, self.counts),
            stiffness: Stiffness {
                triangles: &self.stiffness_of_triangles,
                quads: &self.stiffness_of_quads,
            },
            cells: Cells::baked(
                &self.packed_triangles,
                &self.packed_quads,
                &self.vertex_weights,
                &self.edge_weights,
                &self.order,
            ),
            metric: Metric {
                at_points: &self.metric,
                factors: &self.factors,
                above: &self.above,
                missed: self.missed,
                place: &self.metric_place,
                distortions: &self.distortions,
            },
            stability: self.stability,
        }
    }

    /// The features of the kernel that the scene needs.
    pub fn features(&self) -> Vec<&'static str> {
        let needs = [
            ("triangles", !self.of_triangles.is_empty()),
            ("quads", !self.of_quads.is_empty()),
            ("varying", !self.metric_place.is_empty()),
            ("pieces", !(self.factors.is_empty() && self.data.forms.laws.is_empty())),
            ("distorted", !self.distortions.is_empty()),
            ("contact", self.counts.contact > 0),
            ("limited", !self.data.loads.spans.is_empty()),
            ("robin", !self.data.loads.robin.is_empty()),
            ("transfer", self.data.varies(Field::Coefficient)),
            ("storage", self.stored.is_some()),
            ("curved", self.data.is_curved()),
            ("micromath", self.how.fast),
        ];
        needs.into_iter().filter(|(_, needed)| *needed).map(|(name, _)| name).collect()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.counts.unknowns()
    }
}

/// The entries of an array that is needed, or none.
fn kept<T: Clone>(all: &[T], is_needed: bool) -> Vec<T> {
    if is_needed { all.to_vec() } else { Vec::new() }
}

/// For every vertex where a Dirichlet edge meets a contact edge on which u ≥ ψ is the law, an end of either.
fn corners(problem: &Problem) -> Vec<[u32; 2]> {
    let counts = problem.topology.counts;
    let contact = counts.free..counts.unknowns();
    let ends = contact.flat_map(|edge| problem.ends[edge]).zip(0..);
    let is_above = |place: u32| {
        let range = problem.loads.flux_range(place as usize / 2);
        range.span().length() == f64::INFINITY
    };
    let on_contact: HashMap<u32, u32> = ends.filter(|&(_, place)| is_above(place)).collect();
    let given = (counts.unknowns()..counts.edges()).flat_map(|edge| problem.ends[edge]).zip(0..);
    given.filter_map(|(vertex, place)| Some([*on_contact.get(&vertex)?, place])).collect()
}
