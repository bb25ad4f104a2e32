//! Expressions, taken apart into operations on single numbers.

use naga::{
    BinaryOperator as B, Expression, Handle, Literal, MathFunction as F, RelationalFunction,
    ScalarKind, TypeInner, UnaryOperator,
};

use super::super::RoutineError;
use super::super::mathematics;
use super::super::program::{Arith, Comparison, Logic, Op, Slot, SlotKind, Whole};
use super::build::{Builder, CompiledValue, Constancy};
use super::function::{Argument, CallFrame, Local, Variable};

type Built<T> = Result<T, RoutineError>;

impl<'a> Builder<'a> {
    /// Works out an expression where the text has it.
    pub fn emit(&mut self, frame: &mut CallFrame<'a>, handle: Handle<Expression>) -> Built<()> {
        let types = &self.module().types;
        let inner = frame.info[handle].ty.inner_with(types);
        if matches!(
            inner,
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. }
        ) {
            return Ok(());
        }
        let span = frame.function.expressions.get_span(handle);
        if let Some(range) = span.to_range().filter(|range| range.end > 0) {
            self.at = range.start;
        }
        let value = self.work(frame, handle)?;
        frame.values.insert(handle, value.clone());
        self.note_named(frame, handle, &value);
        Ok(())
    }

    /// The value of an expression that was worked out, or that needs no work.
    pub fn value(
        &mut self,
        frame: &mut CallFrame<'a>,
        handle: Handle<Expression>,
    ) -> Built<CompiledValue> {
        match frame.values.get(&handle) {
            Some(value) => Ok(value.clone()),
            None => self.work(frame, handle),
        }
    }

    /// The value of an expression outside functions.
    pub fn global_value(&mut self, handle: Handle<Expression>) -> Built<CompiledValue> {
        let expressions = &self.module().global_expressions;
        match &expressions[handle] {
            Expression::Compose { components, .. } => {
                let mut slots = Vec::new();
                for component in components {
                    slots.extend(self.global_value(*component)?.slots);
                }
                Ok(always(slots))
            }
            Expression::Splat { size, value } => {
                let slot = self.global_value(*value)?.slots[0];
                Ok(always(vec![slot; *size as usize]))
            }
            Expression::Literal(literal) => self.literal(*literal),
            Expression::Constant(constant) => {
                self.global_value(self.module().constants[*constant].init)
            }
            Expression::ZeroValue(ty) => self.zero(&self.module().types[*ty].inner),
            _ => self.refuse("this constant is not read here"),
        }
    }

    pub fn zero(&mut self, inner: &TypeInner) -> Built<CompiledValue> {
        let mut slots = Vec::new();
        for kind in self.kinds(inner)? {
            let at = self.constant(kind, 0.0)?;
            slots.push(Slot::new(kind, at));
        }
        Ok(always(slots))
    }

    fn literal(&mut self, literal: Literal) -> Built<CompiledValue> {
        let (kind, value) = match literal {
            Literal::F32(x) => (SlotKind::Single, f64::from(x)),
            Literal::F64(x) => (SlotKind::Double, x),
            Literal::AbstractFloat(x) => (SlotKind::Single, x),
            Literal::I32(x) => (SlotKind::Int, x.into()),
            Literal::U32(x) => (SlotKind::Uint, x.into()),
            Literal::AbstractInt(x) => (SlotKind::Int, x as f64),
            Literal::Bool(x) => (SlotKind::Bool, f64::from(u8::from(x))),
            _ => return self.refuse("numbers are float, double, int, uint and bool"),
        };
        let at = self.constant(kind, value)?;
        Ok(always(vec![Slot::new(kind, at)]))
    }

    /// What a pointer points to, if it is a variable that is stored.
    pub fn pointer_if_any(
        &self,
        frame: &CallFrame<'a>,
        handle: Handle<Expression>,
    ) -> Option<Variable> {
        self.pointer(frame, handle).ok()
    }

    pub fn pointer(&self, frame: &CallFrame<'a>, handle: Handle<Expression>) -> Built<Variable> {
        let expressions = &frame.function.expressions;
        match &expressions[handle] {
            Expression::LocalVariable(local) => match frame.locals.get(local) {
                Some(Local::Stored(storage)) => Ok(Variable::whole(self, *storage)),
                _ => self.refuse("this variable is not stored"),
            },
            Expression::GlobalVariable(global) => match self.globals.get(global) {
                Some(storage) => Ok(Variable::whole(self, *storage)),
                None => self.refuse("a routine gets only a ray and a sphere"),
            },
            Expression::FunctionArgument(i) => match frame.arguments.get(*i as usize) {
                Some(Argument::Variable(variable)) => Ok(*variable),
                _ => self.refuse("this parameter is not written to"),
            },
            Expression::AccessIndex { base, index } => {
                let variable = self.pointer(frame, *base)?;
                let (from, count) = self.part(self.pointed(frame, *base), *index)?;
                Ok(Variable {
                    from: variable.from + from,
                    count,
                    ..variable
                })
            }
            Expression::Access { base, index } => {
                let variable = self.pointer(frame, *base)?;
                let index = self.index(frame, *index)?;
                let (from, count) = self.part(self.pointed(frame, *base), index)?;
                Ok(Variable {
                    from: variable.from + from,
                    count,
                    ..variable
                })
            }
            _ => self.refuse("this is no variable"),
        }
    }

    /// The type that a pointer points to.
    fn pointed(&self, frame: &CallFrame<'a>, handle: Handle<Expression>) -> &'a TypeInner {
        let types = &self.parsed.module.types;
        match frame.info[handle].ty.inner_with(types) {
            TypeInner::Pointer { base, .. } => &types[*base].inner,
            inner => inner,
        }
    }

    fn index(&self, frame: &CallFrame<'a>, handle: Handle<Expression>) -> Built<u32> {
        match frame.function.expressions[handle] {
            Expression::Literal(Literal::I32(i)) => {
                u32::try_from(i).or_else(|_| self.refuse("an index below 0"))
            }
            Expression::Literal(Literal::U32(i)) => Ok(i),
            _ => self.refuse("an index is a whole number, written out"),
        }
    }

    /// Where a part of a type lies, and of how many numbers it is.
    fn part(&self, inner: &TypeInner, index: u32) -> Built<(usize, usize)> {
        let types = &self.module().types;
        let index = index as usize;
        match inner {
            TypeInner::Vector { .. } => Ok((index, 1)),
            TypeInner::Struct { members, .. } => {
                let mut from = 0;
                for (i, member) in members.iter().enumerate() {
                    let count = self.kinds(&types[member.ty].inner)?.len();
                    if i == index {
                        return Ok((from, count));
                    }
                    from += count;
                }
                self.refuse("there is no such part")
            }
            TypeInner::Array { base, .. } => {
                let count = self.kinds(&types[*base].inner)?.len();
                Ok((index * count, count))
            }
            _ => self.refuse("this has no parts"),
        }
    }

    #[expect(clippy::too_many_lines, reason = "one arm for each kind of expression")]
    fn work(
        &mut self,
        frame: &mut CallFrame<'a>,
        handle: Handle<Expression>,
    ) -> Built<CompiledValue> {
        let function = frame.function;
        match &function.expressions[handle] {
            Expression::Literal(literal) => self.literal(*literal),
            Expression::Constant(constant) => {
                self.global_value(self.parsed.module.constants[*constant].init)
            }
            Expression::ZeroValue(ty) => self.zero(&self.parsed.module.types[*ty].inner),
            Expression::Compose { components, .. } => {
                let mut parts = Vec::new();
                for component in components {
                    parts.push(self.value(frame, *component)?);
                }
                let constancy = self.all(parts.iter().map(|part| part.constancy))?;
                Ok(CompiledValue {
                    slots: parts.into_iter().flat_map(|part| part.slots).collect(),
                    constancy,
                    of: None,
                })
                .and_then(|value| self.unaliased(frame, value, components))
            }
            Expression::Splat { size, value } => {
                let one = self.value(frame, *value)?;
                Ok(CompiledValue {
                    slots: vec![one.slots[0]; *size as usize],
                    ..one
                })
            }
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let whole = self.value(frame, *vector)?;
                let slots = pattern[..*size as usize]
                    .iter()
                    .map(|component| whole.slots[*component as usize]);
                Ok(CompiledValue {
                    slots: slots.collect(),
                    ..whole
                })
            }
            Expression::AccessIndex { base, index } => self.access(frame, *base, *index),
            Expression::Access { base, index } => {
                let index = self.index(frame, *index)?;
                self.access(frame, *base, index)
            }
            Expression::FunctionArgument(i) => match frame.arguments.get(*i as usize) {
                Some(Argument::CompiledValue(value)) => Ok(value.clone()),
                _ => self.refuse("this parameter is written to, not read"),
            },
            Expression::Load { pointer } => self.load(frame, *pointer),
            Expression::Unary { op, expr } => {
                let of = self.value(frame, *expr)?;
                self.unary(*op, &of)
            }
            Expression::Binary { op, left, right } => self.binary(frame, *op, *left, *right),
            Expression::Select {
                condition,
                accept,
                reject,
            } => {
                let [condition, accept, reject] = [condition, accept, reject].map(|h| *h);
                let condition = self.value(frame, condition)?;
                let accept = self.value(frame, accept)?;
                let reject = self.value(frame, reject)?;
                self.selected(&condition, &accept, &reject)
            }
            Expression::Relational { fun, argument } => {
                let of = self.value(frame, *argument)?;
                self.relational(*fun, &of)
            }
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => {
                let mut arguments = vec![self.value(frame, *arg)?];
                for argument in [arg1, arg2].into_iter().flatten() {
                    arguments.push(self.value(frame, *argument)?);
                }
                let exponent = arg1.and_then(|arg| whole_exponent(&function.expressions[arg]));
                self.math(*fun, &arguments, exponent)
            }
            Expression::As {
                expr,
                kind,
                convert,
            } => {
                let of = self.value(frame, *expr)?;
                let Some(width) = convert else {
                    return self.refuse("bits are not read as another type here");
                };
                self.converted(&of, *kind, *width)
            }
            Expression::CallResult(_) => self.refuse("this function gives nothing"),
            Expression::Derivative { .. } => {
                self.refuse("a routine has no neighbours to differ from")
            }
            _ => self.refuse("this expression is not run here"),
        }
    }

    /// A value made of several: what lies in variables is copied, for one value has one variable at most.
    fn unaliased(
        &mut self,
        frame: &mut CallFrame<'a>,
        mut value: CompiledValue,
        parts: &[Handle<Expression>],
    ) -> Built<CompiledValue> {
        let mut at = 0;
        for part in parts {
            let part = self.value(frame, *part)?;
            if part.of.is_some() {
                for slot in &mut value.slots[at..at + part.slots.len()] {
                    let to = self.fresh_slot(slot.kind)?;
                    self.push(super::super::program::ProgramStep::Put { to, from: *slot });
                    *slot = to;
                }
            }
            at += part.slots.len();
        }
        Ok(value)
    }

    fn access(
        &mut self,
        frame: &mut CallFrame<'a>,
        base: Handle<Expression>,
        index: u32,
    ) -> Built<CompiledValue> {
        let whole = self.value(frame, base)?;
        let types = &self.parsed.module.types;
        let (from, count) = self.part(frame.info[base].ty.inner_with(types), index)?;
        Ok(CompiledValue {
            slots: whole.slots[from..from + count].to_vec(),
            ..whole
        })
    }

    fn load(
        &mut self,
        frame: &mut CallFrame<'a>,
        pointer: Handle<Expression>,
    ) -> Built<CompiledValue> {
        if let Some(value) = self.once(frame, pointer)? {
            return Ok(value);
        }
        let variable = self.pointer(frame, pointer)?;
        let storage = &self.storage[variable.storage];
        let value = CompiledValue {
            slots: variable.slots(self),
            constancy: Constancy::Flag(storage.flag),
            of: Some(variable.storage),
        };
        // A function that is called in between may write what all functions see.
        if self
            .globals
            .values()
            .any(|global| *global == variable.storage)
        {
            let mut copy = value;
            for slot in &mut copy.slots {
                let to = self.fresh_slot(slot.kind)?;
                self.push(super::super::program::ProgramStep::Put { to, from: *slot });
                *slot = to;
            }
            return Ok(CompiledValue { of: None, ..copy });
        }
        Ok(value)
    }

    /// A variable that is written once is its value; none for others.
    fn once(
        &mut self,
        frame: &mut CallFrame<'a>,
        pointer: Handle<Expression>,
    ) -> Built<Option<CompiledValue>> {
        let function = frame.function;
        match &function.expressions[pointer] {
            Expression::LocalVariable(local) => match frame.locals.get(local) {
                Some(Local::Once(Some(value))) => Ok(Some(value.clone())),
                Some(Local::Once(None)) => {
                    let ty = function.local_variables[*local].ty;
                    self.zero(&self.parsed.module.types[ty].inner).map(Some)
                }
                _ => Ok(None),
            },
            Expression::AccessIndex { base, index } => {
                let Some(whole) = self.once(frame, *base)? else {
                    return Ok(None);
                };
                let (from, count) = self.part(self.pointed(frame, *base), *index)?;
                Ok(Some(CompiledValue {
                    slots: whole.slots[from..from + count].to_vec(),
                    ..whole
                }))
            }
            Expression::Access { base, index } => {
                let Some(whole) = self.once(frame, *base)? else {
                    return Ok(None);
                };
                let index = self.index(frame, *index)?;
                let (from, count) = self.part(self.pointed(frame, *base), index)?;
                Ok(Some(CompiledValue {
                    slots: whole.slots[from..from + count].to_vec(),
                    ..whole
                }))
            }
            _ => Ok(None),
        }
    }

    /// Constant where all parts are.
    fn all(&mut self, parts: impl Iterator<Item = Constancy>) -> Built<Constancy> {
        let mut all = Constancy::Always;
        for part in parts {
            all = match (all, part) {
                (Constancy::Never, _) | (_, Constancy::Never) => Constancy::Never,
                (Constancy::Always, other) | (other, Constancy::Always) => other,
                (Constancy::Flag(one), Constancy::Flag(other)) => {
                    Constancy::Flag(self.logic(Logic::And, false, [one, other])?)
                }
            };
        }
        Ok(all)
    }

    fn unary(&mut self, op: UnaryOperator, of: &CompiledValue) -> Built<CompiledValue> {
        let mut slots = Vec::new();
        for slot in &of.slots {
            slots.push(match (op, slot.kind) {
                (UnaryOperator::Negate, kind) if kind.is_real() => {
                    self.arith(Arith::Neg, kind, &[*slot])?
                }
                (UnaryOperator::Negate, _) => self.whole(Whole::Neg, [*slot, *slot])?,
                (UnaryOperator::LogicalNot, _) => {
                    let at = self.logic(Logic::Not, false, [slot.at, 0])?;
                    Slot::new(SlotKind::Bool, at)
                }
                (UnaryOperator::BitwiseNot, _) => self.whole(Whole::Not, [*slot, *slot])?,
            });
        }
        Ok(CompiledValue {
            slots,
            constancy: worked(&[of]),
            of: None,
        })
    }

    fn whole(&mut self, op: Whole, of: [Slot; 2]) -> Built<Slot> {
        let kind = of[0].kind;
        let to = self.fresh(kind)?;
        self.operate(Op::Whole {
            op,
            unsigned: kind == SlotKind::Uint,
            to,
            of: of.map(|slot| slot.at),
        })?;
        Ok(Slot::new(kind, to))
    }

    fn binary(
        &mut self,
        frame: &mut CallFrame<'a>,
        op: B,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Built<CompiledValue> {
        let types = &self.parsed.module.types;
        for side in [left, right] {
            if matches!(
                frame.info[side].ty.inner_with(types),
                TypeInner::Matrix { .. }
            ) {
                return self.refuse("matrices are not run here");
            }
        }
        let [x, y] = [self.value(frame, left)?, self.value(frame, right)?];
        let fused = if self.contract && matches!(op, B::Add | B::Subtract) {
            self.fused(frame, op, (left, &x), (right, &y))?
        } else {
            None
        };
        let count = x.slots.len().max(y.slots.len());
        let at = |value: &CompiledValue, i: usize| {
            value.slots[if value.slots.len() == 1 { 0 } else { i }]
        };
        let mut slots = fused.unwrap_or_default();
        for i in slots.len()..count {
            let slot = self.binary_one(op, at(&x, i), at(&y, i))?;
            slots.push(slot);
        }
        // Vectors are compared as a whole by == and !=.
        Ok(CompiledValue {
            slots,
            constancy: worked(&[&x, &y]),
            of: None,
        })
    }

    /// A product and the sum that uses it, rounded once.
    fn fused(
        &mut self,
        frame: &mut CallFrame<'a>,
        op: B,
        (left, x): (Handle<Expression>, &CompiledValue),
        (right, y): (Handle<Expression>, &CompiledValue),
    ) -> Built<Option<Vec<Slot>>> {
        let function = frame.function;
        let factors = |handle: Handle<Expression>| match function.expressions[handle] {
            Expression::Binary {
                op: B::Multiply,
                left,
                right,
            } => Some([left, right]),
            _ => None,
        };
        let (product, other, first) = match (factors(left), factors(right)) {
            (Some(product), _) => (product, y, true),
            (None, Some(product)) => (product, x, false),
            (None, None) => return Ok(None),
        };
        let [p, q] = [
            self.value(frame, product[0])?,
            self.value(frame, product[1])?,
        ];
        let at = |value: &CompiledValue, i: usize| {
            value.slots[if value.slots.len() == 1 { 0 } else { i }]
        };
        let mut slots = Vec::new();
        for i in 0..x.slots.len().max(y.slots.len()) {
            let (mut p, q, mut z) = (at(&p, i), at(&q, i), at(other, i));
            if !p.kind.is_real() {
                return Ok(None);
            }
            match (op, first) {
                (B::Subtract, true) => z = self.arith(Arith::Neg, z.kind, &[z])?,
                (B::Subtract, false) => p = self.arith(Arith::Neg, p.kind, &[p])?,
                _ => {}
            }
            slots.push(self.arith(Arith::MulAdd, p.kind, &[p, q, z])?);
        }
        Ok(Some(slots))
    }

    fn binary_one(&mut self, op: B, x: Slot, y: Slot) -> Built<Slot> {
        let comparison = match op {
            B::Equal => Some(Comparison::Equal),
            B::NotEqual => Some(Comparison::NotEqual),
            B::Less => Some(Comparison::Less),
            B::LessEqual => Some(Comparison::LessEqual),
            B::Greater => Some(Comparison::Greater),
            B::GreaterEqual => Some(Comparison::GreaterEqual),
            _ => None,
        };
        if let Some(comparison) = comparison {
            if x.kind == SlotKind::Bool {
                let op = if op == B::Equal {
                    Logic::Equal
                } else {
                    Logic::NotEqual
                };
                let at = self.logic(op, false, [x.at, y.at])?;
                return Ok(Slot::new(SlotKind::Bool, at));
            }
            return self.compare(comparison, [x, y]);
        }
        if x.kind == SlotKind::Bool {
            let op = match op {
                B::LogicalAnd | B::And => Logic::And,
                B::LogicalOr | B::InclusiveOr => Logic::Or,
                B::ExclusiveOr => Logic::NotEqual,
                _ => return self.refuse("true and false are joined by && and ||"),
            };
            let at = self.logic(op, false, [x.at, y.at])?;
            return Ok(Slot::new(SlotKind::Bool, at));
        }
        if x.kind.is_real() {
            let arith = match op {
                B::Add => Arith::Add,
                B::Subtract => Arith::Sub,
                B::Multiply => Arith::Mul,
                B::Divide => Arith::Div,
                _ => return self.refuse("the operators for real numbers are + - * and /"),
            };
            return self.arith(arith, x.kind, &[x, y]);
        }
        let whole = match op {
            B::Add => Whole::Add,
            B::Subtract => Whole::Sub,
            B::Multiply => Whole::Mul,
            B::Divide => Whole::Div,
            B::Modulo => Whole::Rem,
            B::And => Whole::And,
            B::ExclusiveOr => Whole::Xor,
            B::InclusiveOr => Whole::Or,
            B::ShiftLeft => Whole::ShiftLeft,
            B::ShiftRight => Whole::ShiftRight,
            _ => return self.refuse("this operator is not run here"),
        };
        self.whole(whole, [x, y])
    }

    fn selected(
        &mut self,
        condition: &CompiledValue,
        accept: &CompiledValue,
        reject: &CompiledValue,
    ) -> Built<CompiledValue> {
        let mut slots = Vec::new();
        for (i, pair) in accept.slots.iter().zip(&reject.slots).enumerate() {
            let condition = condition.slots[if condition.slots.len() == 1 { 0 } else { i }];
            slots.push(self.select(condition.at, [*pair.0, *pair.1])?);
        }
        let constancy = match (accept.constancy, reject.constancy) {
            (Constancy::Always, Constancy::Always) => Constancy::Always,
            (Constancy::Never, Constancy::Never) => Constancy::Never,
            (one, other) => {
                let mut at = |constancy| match constancy {
                    Constancy::Flag(flag) => Ok(flag),
                    known => self.truth(known == Constancy::Always),
                };
                let of = [at(one)?, at(other)?].map(|at| Slot::new(SlotKind::Bool, at));
                Constancy::Flag(self.select(condition.slots[0].at, of)?.at)
            }
        };
        Ok(CompiledValue {
            slots,
            constancy,
            of: None,
        })
    }

    fn relational(
        &mut self,
        function: RelationalFunction,
        of: &CompiledValue,
    ) -> Built<CompiledValue> {
        use RelationalFunction as R;
        let mut slots = Vec::new();
        for slot in &of.slots {
            let wide = slot.kind == SlotKind::Double;
            match function {
                R::IsNan => slots.push(self.logic(Logic::IsNan, wide, [slot.at, 0])?),
                R::IsInf => slots.push(self.logic(Logic::IsInf, wide, [slot.at, 0])?),
                R::All | R::Any => {
                    let op = if function == R::All {
                        Logic::And
                    } else {
                        Logic::Or
                    };
                    let joined = match slots.last() {
                        Some(&before) => self.logic(op, false, [before, slot.at])?,
                        None => slot.at,
                    };
                    slots = vec![joined];
                }
            }
        }
        Ok(CompiledValue {
            slots: slots
                .into_iter()
                .map(|at| Slot::new(SlotKind::Bool, at))
                .collect(),
            constancy: worked(&[of]),
            of: None,
        })
    }

    fn converted(
        &mut self,
        of: &CompiledValue,
        kind: ScalarKind,
        width: u8,
    ) -> Built<CompiledValue> {
        let kind = self.kind(naga::Scalar { kind, width })?;
        let mut slots = Vec::new();
        for from in &of.slots {
            if from.kind == kind {
                slots.push(*from);
                continue;
            }
            let to = self.fresh_slot(kind)?;
            self.operate(Op::Convert { from: *from, to })?;
            slots.push(to);
        }
        Ok(CompiledValue {
            slots,
            constancy: worked(&[of]),
            of: of.of,
        })
    }

    fn math(
        &mut self,
        function: F,
        arguments: &[CompiledValue],
        exponent: Option<u32>,
    ) -> Built<CompiledValue> {
        let slots = self.math_slots(function, arguments, exponent)?;
        Ok(CompiledValue {
            slots,
            constancy: worked(&arguments.iter().collect::<Vec<_>>()),
            of: None,
        })
    }

    fn math_slots(
        &mut self,
        function: F,
        arguments: &[CompiledValue],
        exponent: Option<u32>,
    ) -> Built<Vec<Slot>> {
        let x = &arguments[0].slots;
        let other = |i: usize| arguments.get(i).map(|value| &value.slots);
        match function {
            F::Dot => return Ok(vec![self.dot(x, other(1).unwrap_or(x))?]),
            F::Length => return Ok(vec![self.length(x)?]),
            F::Distance => {
                let apart = self.each(Arith::Sub, x, other(1).unwrap_or(x))?;
                return Ok(vec![self.length(&apart)?]);
            }
            F::Normalize => {
                let square = self.dot(x, x)?;
                let scale = self.inverse_root(square)?;
                return self.each(Arith::Mul, x, &[scale]);
            }
            F::Cross => return self.cross(x, other(1).unwrap_or(x)),
            F::Reflect => {
                let n = other(1).unwrap_or(x);
                let dot = self.dot(n, x)?;
                let two = Slot::new(dot.kind, self.constant(dot.kind, 2.0)?);
                let twice = self.arith(Arith::Mul, dot.kind, &[two, dot])?;
                let part = self.each(Arith::Mul, n, &[twice])?;
                return self.each(Arith::Sub, x, &part);
            }
            F::FaceForward => {
                let [i, n] = [other(1).unwrap_or(x), other(2).unwrap_or(x)];
                let dot = self.dot(n, i)?;
                let zero = Slot::new(dot.kind, self.constant(dot.kind, 0.0)?);
                let toward = self.compare(Comparison::Less, [dot, zero])?;
                let mut slots = Vec::new();
                for slot in x {
                    let away = self.arith(Arith::Neg, slot.kind, &[*slot])?;
                    slots.push(self.select(toward.at, [*slot, away])?);
                }
                return Ok(slots);
            }
            F::Pow => {
                let Some(exponent) = exponent else {
                    return self.refuse("pow is run with a whole exponent from 1 to 8, written out: a product, left to right");
                };
                let mut power = x.clone();
                for _ in 1..exponent {
                    power = self.each(Arith::Mul, &power, x)?;
                }
                return Ok(power);
            }
            _ => {}
        }
        let mut slots = Vec::new();
        for i in 0..x.len() {
            let at = |value: &Vec<Slot>| value[if value.len() == 1 { 0 } else { i }];
            let operands: Vec<Slot> = arguments.iter().map(|value| at(&value.slots)).collect();
            slots.push(self.math_one(function, &operands)?);
        }
        Ok(slots)
    }

    fn math_one(&mut self, function: F, of: &[Slot]) -> Built<Slot> {
        let x = of[0];
        if !x.kind.is_real() {
            return self.whole_math(function, of);
        }
        let kind = x.kind;
        let simple = match function {
            F::Abs => Some(Arith::Abs),
            F::Sqrt => Some(Arith::Sqrt),
            F::Min => Some(Arith::Min),
            F::Max => Some(Arith::Max),
            F::Floor => Some(Arith::Floor),
            F::Ceil => Some(Arith::Ceil),
            F::Trunc => Some(Arith::Trunc),
            F::Round => Some(Arith::Round),
            F::Sign => Some(Arith::Sign),
            F::Fma => Some(Arith::MulAdd),
            _ => None,
        };
        if let Some(op) = simple {
            return self.arith(op, kind, of);
        }
        match function {
            F::InverseSqrt => self.inverse_root(x),
            F::Clamp => {
                let above = self.arith(Arith::Max, kind, &[x, of[1]])?;
                self.arith(Arith::Min, kind, &[above, of[2]])
            }
            F::Saturate => {
                let [zero, one] = [self.number(kind, 0.0)?, self.number(kind, 1.0)?];
                let above = self.arith(Arith::Max, kind, &[x, zero])?;
                self.arith(Arith::Min, kind, &[above, one])
            }
            F::Fract => {
                let floor = self.arith(Arith::Floor, kind, &[x])?;
                self.arith(Arith::Sub, kind, &[x, floor])
            }
            F::Mix => {
                let one = self.number(kind, 1.0)?;
                let rest = self.arith(Arith::Sub, kind, &[one, of[2]])?;
                let from = self.arith(Arith::Mul, kind, &[x, rest])?;
                let to = self.arith(Arith::Mul, kind, &[of[1], of[2]])?;
                self.arith(Arith::Add, kind, &[from, to])
            }
            F::Step => {
                let below = self.compare(Comparison::Less, [of[1], x])?;
                let [zero, one] = [self.number(kind, 0.0)?, self.number(kind, 1.0)?];
                self.select(below.at, [zero, one])
            }
            F::SmoothStep => {
                let over = self.arith(Arith::Sub, kind, &[of[2], x])?;
                let width = self.arith(Arith::Sub, kind, &[of[1], x])?;
                let part = self.arith(Arith::Div, kind, &[over, width])?;
                let t = self.math_one(F::Saturate, &[part])?;
                let [two, three] = [self.number(kind, 2.0)?, self.number(kind, 3.0)?];
                let twice = self.arith(Arith::Mul, kind, &[two, t])?;
                let rest = self.arith(Arith::Sub, kind, &[three, twice])?;
                let square = self.arith(Arith::Mul, kind, &[t, t])?;
                self.arith(Arith::Mul, kind, &[square, rest])
            }
            function => self.refuse(mathematics::refusal(function)),
        }
    }

    fn whole_math(&mut self, function: F, of: &[Slot]) -> Built<Slot> {
        let op = match function {
            F::Abs => Whole::Abs,
            F::Min => Whole::Min,
            F::Max => Whole::Max,
            F::Clamp => {
                let above = self.whole(Whole::Max, [of[0], of[1]])?;
                return self.whole(Whole::Min, [above, of[2]]);
            }
            function => return self.refuse(mathematics::refusal(function)),
        };
        self.whole(op, [of[0], *of.get(1).unwrap_or(&of[0])])
    }

    fn number(&mut self, kind: SlotKind, value: f64) -> Built<Slot> {
        Ok(Slot::new(kind, self.constant(kind, value)?))
    }

    fn each(&mut self, op: Arith, x: &[Slot], y: &[Slot]) -> Built<Vec<Slot>> {
        let mut slots = Vec::new();
        for (i, one) in x.iter().enumerate() {
            let other = y[if y.len() == 1 { 0 } else { i }];
            slots.push(self.arith(op, one.kind, &[*one, other])?);
        }
        Ok(slots)
    }

    /// Products, added from the left to the right.
    fn dot(&mut self, x: &[Slot], y: &[Slot]) -> Built<Slot> {
        let kind = x[0].kind;
        if !kind.is_real() {
            return self.refuse("dot is run over real numbers");
        }
        let mut sum: Option<Slot> = None;
        for (i, (one, other)) in x.iter().zip(y).enumerate() {
            sum = Some(match sum {
                // As compilers contract x·x′ + y·y′ + z·z′: the first product into the first sum.
                None if self.contract && x.len() > 1 && i == 0 => {
                    let second = self.arith(Arith::Mul, kind, &[x[1], y[1]])?;
                    self.arith(Arith::MulAdd, kind, &[*one, *other, second])?
                }
                Some(sum) if self.contract && i == 1 => sum,
                Some(sum) if self.contract => {
                    self.arith(Arith::MulAdd, kind, &[*one, *other, sum])?
                }
                None => self.arith(Arith::Mul, kind, &[*one, *other])?,
                Some(sum) => {
                    let product = self.arith(Arith::Mul, kind, &[*one, *other])?;
                    self.arith(Arith::Add, kind, &[sum, product])?
                }
            });
        }
        match sum {
            Some(sum) => Ok(sum),
            None => self.refuse("dot of nothing"),
        }
    }

    fn length(&mut self, x: &[Slot]) -> Built<Slot> {
        if let [one] = x {
            return self.arith(Arith::Abs, one.kind, &[*one]);
        }
        let square = self.dot(x, x)?;
        self.arith(Arith::Sqrt, square.kind, &[square])
    }

    /// 1/√x, rounded twice.
    fn inverse_root(&mut self, x: Slot) -> Built<Slot> {
        let root = self.arith(Arith::Sqrt, x.kind, &[x])?;
        let one = self.number(x.kind, 1.0)?;
        self.arith(Arith::Div, x.kind, &[one, root])
    }

    fn cross(&mut self, x: &[Slot], y: &[Slot]) -> Built<Vec<Slot>> {
        let mut slots = Vec::new();
        for i in 0..3 {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            let kind = x[0].kind;
            let one = self.arith(Arith::Mul, kind, &[x[j], y[k]])?;
            let other = self.arith(Arith::Mul, kind, &[x[k], y[j]])?;
            slots.push(self.arith(Arith::Sub, kind, &[one, other])?);
        }
        Ok(slots)
    }
}

fn always(slots: Vec<Slot>) -> CompiledValue {
    CompiledValue {
        slots,
        constancy: Constancy::Always,
        of: None,
    }
}

/// What is worked out of constants alone is one.
fn worked(of: &[&CompiledValue]) -> Constancy {
    let all = of.iter().all(|value| value.constancy == Constancy::Always);
    if all {
        Constancy::Always
    } else {
        Constancy::Never
    }
}

fn whole_exponent(expression: &Expression) -> Option<u32> {
    let value = match expression {
        Expression::Literal(Literal::F32(x)) => f64::from(*x),
        Expression::Literal(Literal::F64(x)) => *x,
        _ => return None,
    };
    (1..=8).find(|&n| f64::from(n) == value)
}
