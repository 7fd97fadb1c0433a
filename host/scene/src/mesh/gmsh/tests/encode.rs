//! Writes a mesh in each format and encoding, right or wrong as the test wants it.

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Coding {
    Ascii,
    Little,
    Big,
}

pub(super) const CODINGS: [Coding; 3] = [Coding::Ascii, Coding::Little, Coding::Big];

/// A mesh as a file says it: elements are (number, type, physical tags, nodes).
#[derive(Clone)]
pub(super) struct Model {
    pub(super) names: Vec<(i32, i32, &'static str)>,
    pub(super) nodes: Vec<(i32, [f64; 3])>,
    pub(super) elements: Vec<(i32, i32, Vec<i32>, Vec<i32>)>,
}

impl Model {
    /// Format 2.2: an element once for each of its physical tags.
    pub(super) fn v22(&self, coding: Coding) -> Vec<u8> {
        let mut w = self.head("2.2", coding);
        w.text(&format!("$Nodes\n{}\n", self.nodes.len()));
        for &(tag, point) in &self.nodes {
            w.int(tag).floats(&point).end();
        }
        w.close("$EndNodes\n");
        let listed: Vec<_> = self
            .elements
            .iter()
            .flat_map(|(tag, kind, groups, nodes)| {
                let groups = if groups.is_empty() { &[0][..] } else { groups };
                groups.iter().map(move |&group| (*tag, *kind, group, nodes))
            })
            .collect();
        w.text(&format!("$Elements\n{}\n", listed.len()));
        for (tag, kind, group, nodes) in listed {
            match coding {
                Coding::Ascii => w.int(tag).int(kind).int(2).int(group).int(1),
                _ => w.int(kind).int(1).int(2).int(tag).int(group).int(1),
            };
            nodes.iter().fold(&mut w, |w, &node| w.int(node)).end();
        }
        w.close("$EndElements\n");
        w.bytes
    }

    /// Format 4.1: an entity and a block for each element, two parametric blocks of nodes.
    pub(super) fn v41(&self, coding: Coding) -> Vec<u8> {
        let mut w = self.head("4.1", coding);
        let dimension = |kind| if kind == 15 { 0 } else { 1 + i32::from(kind != 1) };
        w.text("$Entities\n");
        let of = |d| self.elements.iter().filter(move |element| dimension(element.1) == d);
        (0..4).fold(&mut w, |w, d| w.size(of(d).count() as u64)).end();
        for d in 0..3 {
            for (tag, _, groups, _) in of(d) {
                w.int(*tag).floats(&[0.0; 6][..if d == 0 { 3 } else { 6 }]);
                w.size(groups.len() as u64);
                groups.iter().fold(&mut w, |w, &group| w.int(group));
                if d > 0 {
                    w.size(2).int(1).int(-2);
                }
                w.end();
            }
        }
        w.close("$EndEntities\n$Nodes\n");
        let (curve, surface) = self.nodes.split_at(self.nodes.len() / 2);
        w.size(2).size(self.nodes.len() as u64).size(1).size(9).end();
        for (d, nodes) in [(1, curve), (2, surface)] {
            w.int(d).int(1).int(1).size(nodes.len() as u64).end();
            for node in nodes {
                w.size(node.0 as u64).end();
            }
            for node in nodes {
                w.floats(&node.1).floats(&[0.5, 0.25][..d as usize]).end();
            }
        }
        w.close("$EndNodes\n$Elements\n");
        let count = self.elements.len() as u64;
        w.size(count).size(count).size(1).size(9).end();
        for (tag, kind, _, nodes) in &self.elements {
            w.int(dimension(*kind)).int(*tag).int(*kind).size(1).end().size(*tag as u64);
            nodes.iter().fold(&mut w, |w, &node| w.size(node as u64)).end();
        }
        w.close("$EndElements\n");
        w.bytes
    }

    fn head(&self, version: &str, coding: Coding) -> Writer {
        let mut w = Writer { bytes: Vec::new(), coding };
        w.text(&format!("$MeshFormat\n{version} {} 8\n", i32::from(coding != Coding::Ascii)));
        if coding != Coding::Ascii {
            w.int(1);
        }
        w.close("$EndMeshFormat\n");
        w.text(&format!("$PhysicalNames\n{}\n", self.names.len()));
        for (dimension, tag, name) in &self.names {
            w.text(&format!("{dimension} {tag} \"{name}\"\n"));
        }
        w.text("$EndPhysicalNames\n");
        w
    }
}

struct Writer {
    bytes: Vec<u8>,
    coding: Coding,
}

impl Writer {
    fn text(&mut self, text: &str) {
        self.bytes.extend_from_slice(text.as_bytes());
    }

    fn number<const N: usize>(&mut self, text: String, little: [u8; N]) -> &mut Self {
        match self.coding {
            Coding::Ascii => self.text(&(text + " ")),
            Coding::Little => self.bytes.extend(little),
            Coding::Big => self.bytes.extend(little.iter().rev()),
        }
        self
    }

    fn int(&mut self, number: i32) -> &mut Self {
        self.number(number.to_string(), number.to_le_bytes())
    }

    fn size(&mut self, number: u64) -> &mut Self {
        self.number(number.to_string(), number.to_le_bytes())
    }

    fn floats(&mut self, numbers: &[f64]) -> &mut Self {
        numbers.iter().fold(self, |w, x| w.number(x.to_string(), x.to_le_bytes()))
    }

    /// Ends a record.
    fn end(&mut self) -> &mut Self {
        if self.coding == Coding::Ascii {
            self.text("\n");
        }
        self
    }

    fn close(&mut self, marker: &str) {
        if self.coding != Coding::Ascii {
            self.text("\n");
        }
        self.text(marker);
    }
}
