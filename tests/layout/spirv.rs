//! As much of SPIR-V as layouts, bindings and limits need. Numbers are those of the SPIR-V specification.

use std::collections::{BTreeMap, BTreeSet};

/// A type, by the ids of its parts.
#[derive(Clone, Debug)]
pub(crate) enum Type {
    Scalar { bytes: u32 },
    Vector { of: u32, count: u32 },
    Matrix { column: u32, count: u32 },
    Array { of: u32, length: u32 },
    RuntimeArray { of: u32 },
    Struct { members: Vec<u32> },
    Image { dim: u32, sampled: u32 },
    SampledImage,
    RayTree,
    Pointer { of: u32 },
    Other,
}

/// A global variable.
pub(crate) struct Variable {
    pub id: u32,
    pub pointer: u32,
    pub class: u32,
}

/// What a module declares.
#[derive(Default)]
pub(crate) struct Module {
    pub capabilities: BTreeSet<u32>,
    pub extensions: Vec<String>,
    pub local_size: Option<[u32; 3]>,
    pub variables: Vec<Variable>,
    names: BTreeMap<u32, String>,
    member_names: BTreeMap<(u32, u32), String>,
    decorations: BTreeMap<(u32, u32), u32>,
    member_decorations: BTreeMap<(u32, u32, u32), u32>,
    types: BTreeMap<u32, Type>,
    constants: BTreeMap<u32, u32>,
}

pub(crate) mod class {
    pub(crate) const UNIFORM_CONSTANT: u32 = 0;
    pub(crate) const UNIFORM: u32 = 2;
    pub(crate) const WORKGROUP: u32 = 4;
    pub(crate) const PUSH_CONSTANT: u32 = 9;
    pub(crate) const STORAGE_BUFFER: u32 = 12;
}

pub(crate) mod decoration {
    pub(crate) const SPEC_ID: u32 = 1;
    pub(crate) const BLOCK: u32 = 2;
    pub(crate) const ROW_MAJOR: u32 = 4;
    pub(crate) const ARRAY_STRIDE: u32 = 6;
    pub(crate) const MATRIX_STRIDE: u32 = 7;
    pub(crate) const BINDING: u32 = 33;
    pub(crate) const DESCRIPTOR_SET: u32 = 34;
    pub(crate) const OFFSET: u32 = 35;
}

impl Module {
    pub(crate) fn parse(words: &[u32]) -> Self {
        assert_eq!(words[0], 0x0723_0203, "not SPIR-V of this machine's byte order");
        let mut module = Self::default();
        let mut rest = &words[5..];
        while let Some(&head) = rest.first() {
            let length = (head >> 16) as usize;
            module.instruction(head & 0xffff, &rest[1..length]);
            rest = &rest[length..];
        }
        module
    }

    fn instruction(&mut self, opcode: u32, operands: &[u32]) {
        match (opcode, operands) {
            (5, [id, text @ ..]) => drop(self.names.insert(*id, string(text))),
            (6, [id, member, text @ ..]) => {
                self.member_names.insert((*id, *member), string(text));
            }
            (10, text) => self.extensions.push(string(text)),
            // LocalSize.
            (16, [_, 17, x, y, z]) => self.local_size = Some([*x, *y, *z]),
            (17, [capability]) => drop(self.capabilities.insert(*capability)),
            (19..=39 | 5341, [id, operands @ ..]) => {
                self.types.insert(*id, declared_type(opcode, operands));
            }
            (43, [_, id, value, ..]) => drop(self.constants.insert(*id, *value)),
            (59, [pointer, id, class, ..]) => {
                self.variables.push(Variable { id: *id, pointer: *pointer, class: *class })
            }
            (71, [id, decoration, values @ ..]) => {
                let value = values.first().copied().unwrap_or(0);
                self.decorations.insert((*id, *decoration), value);
            }
            (72, [id, member, decoration, values @ ..]) => {
                let value = values.first().copied().unwrap_or(0);
                self.member_decorations.insert((*id, *member, *decoration), value);
            }
            _ => {}
        }
    }

    pub(crate) fn name(&self, id: u32) -> &str {
        self.names.get(&id).map_or("", String::as_str)
    }

    pub(crate) fn member_name(&self, id: u32, member: u32) -> &str {
        self.member_names.get(&(id, member)).map_or("", String::as_str)
    }

    pub(crate) fn decoration(&self, id: u32, decoration: u32) -> Option<u32> {
        self.decorations.get(&(id, decoration)).copied()
    }

    pub(crate) fn member(&self, id: u32, member: u32, decoration: u32) -> Option<u32> {
        self.member_decorations.get(&(id, member, decoration)).copied()
    }

    pub(crate) fn typed(&self, id: u32) -> &Type {
        &self.types[&id]
    }

    /// Ids and member types of the structs that lie in a buffer or a block, by the name that GLSL gave them. The
    /// compiler makes a second struct of that name without offsets for the copies that functions take.
    pub(crate) fn laid_out_structs(&self) -> impl Iterator<Item = (u32, &str, &[u32])> {
        self.types.iter().filter_map(|(&id, typed)| match typed {
            Type::Struct { members } => {
                let laid_out = self.member(id, 0, decoration::OFFSET).is_some();
                laid_out.then(|| (id, self.name(id), &members[..]))
            }
            _ => None,
        })
    }

    /// Every specialisation constant: name, id.
    pub(crate) fn specialization(&self) -> impl Iterator<Item = (&str, u32)> {
        let ids = self.decorations.iter();
        let ids = ids.filter(|((_, decoration), _)| *decoration == decoration::SPEC_ID);
        ids.map(|(&(id, _), &value)| (self.name(id), value))
    }

    /// What a pointer points to, out of its array, and the array's length.
    pub(crate) fn pointee(&self, pointer: u32) -> (u32, u32) {
        let Type::Pointer { of } = self.typed(pointer) else {
            panic!("a variable is a pointer");
        };
        match self.typed(*of) {
            Type::Array { of, length } => (*of, self.constants[length]),
            _ => (*of, 1),
        }
    }

    /// Bytes that a type takes where it is laid out, without padding behind it; none for a runtime array.
    pub(crate) fn extent(&self, id: u32, matrix_stride: u32) -> u32 {
        match self.typed(id) {
            Type::Scalar { bytes } => *bytes,
            Type::Vector { of, count } => count * self.extent(*of, 0),
            Type::Matrix { column, count } => {
                let stride = if matrix_stride > 0 { matrix_stride } else { self.extent(*column, 0) };
                count * stride
            }
            Type::Array { of, length } => {
                let stride = self.decoration(id, decoration::ARRAY_STRIDE);
                self.constants[length] * stride.unwrap_or_else(|| self.extent(*of, 0))
            }
            Type::Struct { members } => self.struct_extent(id, members),
            Type::RuntimeArray { .. } => 0,
            other => panic!("{other:?} has no extent"),
        }
    }

    fn struct_extent(&self, id: u32, members: &[u32]) -> u32 {
        let mut end = 0;
        for (member, &typed) in (0..).zip(members) {
            let begin = self.member(id, member, decoration::OFFSET).unwrap_or(end);
            end = begin + self.member_extent(id, member, typed);
        }
        end
    }

    pub(crate) fn member_extent(&self, id: u32, member: u32, typed: u32) -> u32 {
        let stride = self.member(id, member, decoration::MATRIX_STRIDE);
        self.extent(typed, stride.unwrap_or(0))
    }

    /// Strides of the arrays whose elements are of this type.
    pub(crate) fn strides_of(&self, element: u32) -> impl Iterator<Item = u32> {
        self.types.iter().filter_map(move |(&id, typed)| match typed {
            Type::Array { of, .. } | Type::RuntimeArray { of } if *of == element => {
                self.decoration(id, decoration::ARRAY_STRIDE)
            }
            _ => None,
        })
    }
}

fn declared_type(opcode: u32, operands: &[u32]) -> Type {
    match (opcode, operands) {
        // In buffers there is no bool; elsewhere four bytes is what devices take.
        (20, _) => Type::Scalar { bytes: 4 },
        (21 | 22, [width, ..]) => Type::Scalar { bytes: width / 8 },
        (23, &[of, count]) => Type::Vector { of, count },
        (24, &[column, count]) => Type::Matrix { column, count },
        (25, &[_, dim, _, _, _, sampled, ..]) => Type::Image { dim, sampled },
        (27, _) => Type::SampledImage,
        (5341, _) => Type::RayTree,
        (28, &[of, length]) => Type::Array { of, length },
        (29, &[of]) => Type::RuntimeArray { of },
        (30, members) => Type::Struct { members: members.to_vec() },
        (32, &[_, of]) => Type::Pointer { of },
        _ => Type::Other,
    }
}

/// A string ends with a zero byte inside its last word.
fn string(words: &[u32]) -> String {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let text = bytes.split(|&byte| byte == 0).next().unwrap_or(&[]);
    String::from_utf8_lossy(text).into_owned()
}
