//! Statements: a function is put in where it is called.

use std::collections::{HashMap, HashSet};

use naga::valid::FunctionInfo;
use naga::{Block, Expression, Function, Handle, LocalVariable, Span, Statement};

use super::super::RoutineError;
use super::super::program::{Note, ProgramStep, Returned, Slot, SlotKind};
use super::base;
use super::build::{Builder, CompiledValue, Constancy};

/// How deep calls may nest.
const DEEPEST_CALL: usize = 16;

/// What a function is called with.
#[derive(Debug, Clone)]
pub(super) enum Argument {
    CompiledValue(CompiledValue),
    Variable(Variable),
}

/// A variable, or a part of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variable {
    pub storage: usize,
    pub from: usize,
    pub count: usize,
}

impl Variable {
    pub fn whole(builder: &Builder<'_>, storage: usize) -> Self {
        Self {
            storage,
            from: 0,
            count: builder.storage[storage].slots.len(),
        }
    }

    pub fn slots(self, builder: &Builder<'_>) -> Vec<Slot> {
        builder.storage[self.storage].slots[self.from..self.from + self.count].to_vec()
    }
}

/// A local variable.
#[derive(Debug, Clone)]
pub(super) enum Local {
    /// Written once, before it is read: the value itself.
    Once(Option<CompiledValue>),
    Stored(usize),
}

/// A call that is being put in.
pub(super) struct CallFrame<'a> {
    pub function: &'a Function,
    pub info: &'a FunctionInfo,
    pub arguments: Vec<Argument>,
    pub values: HashMap<Handle<Expression>, CompiledValue>,
    pub locals: HashMap<Handle<LocalVariable>, Local>,
    /// Where what is returned goes.
    result: Option<usize>,
    /// What is returned at the end, if nothing returns before.
    last: Option<CompiledValue>,
    returns_once: bool,
    /// The name, unless it is the routine itself.
    name: Option<String>,
    depth: usize,
}

impl<'a> Builder<'a> {
    /// Puts a function in, and gives what it returns.
    pub fn call(
        &mut self,
        handle: Handle<Function>,
        arguments: &[Argument],
        is_routine: bool,
    ) -> Result<Option<CompiledValue>, RoutineError> {
        self.call_within(handle, arguments, is_routine, 0)
    }

    fn call_within(
        &mut self,
        handle: Handle<Function>,
        arguments: &[Argument],
        is_routine: bool,
        depth: usize,
    ) -> Result<Option<CompiledValue>, RoutineError> {
        if depth > DEEPEST_CALL {
            return self.refuse("functions call one another too deep");
        }
        let parsed = self.parsed;
        let function = &parsed.module.functions[handle];
        let returns_once = returns_at_the_end(&function.body);
        let result = match &function.result {
            Some(given) if !returns_once => {
                let slots = self.fresh_of(given.ty)?;
                Some(self.variable(slots, false))
            }
            _ => None,
        };
        let mut frame = CallFrame {
            function,
            info: &parsed.info[handle],
            arguments: arguments.to_vec(),
            values: HashMap::new(),
            locals: HashMap::new(),
            result,
            last: None,
            returns_once,
            name: function.name.clone().filter(|_| !is_routine),
            depth,
        };
        self.locals(&mut frame)?;
        if returns_once {
            self.statements(&mut frame, &function.body)?;
            return Ok(frame.last);
        }
        let body = self.block(|builder| builder.statements(&mut frame, &function.body))?;
        self.push(ProgramStep::Scope(body));
        Ok(result.map(|storage| {
            let stored = &self.storage[storage];
            CompiledValue {
                slots: stored.slots.clone(),
                constancy: Constancy::Flag(stored.flag),
                of: None,
            }
        }))
    }

    fn locals(&mut self, frame: &mut CallFrame<'a>) -> Result<(), RoutineError> {
        let once = written_once(frame.function);
        for (handle, local) in frame.function.local_variables.iter() {
            if once.contains(&handle) && local.init.is_none() {
                frame.locals.insert(handle, Local::Once(None));
                continue;
            }
            let slots = self.fresh_of(local.ty)?;
            let storage = self.variable(slots, local.init.is_some());
            let value = match local.init {
                Some(init) => self.value(frame, init)?,
                None => self.zero(&self.module().types[local.ty].inner)?,
            };
            self.put(storage, 0, &value);
            frame.locals.insert(handle, Local::Stored(storage));
        }
        Ok(())
    }

    fn statements(&mut self, frame: &mut CallFrame<'a>, block: &Block) -> Result<(), RoutineError> {
        for (statement, span) in block.span_iter() {
            if let Some(range) = span.to_range().filter(|range| range.end > 0) {
                self.at = range.start;
            }
            self.statement(frame, statement, *span)?;
        }
        Ok(())
    }

    fn statement(
        &mut self,
        frame: &mut CallFrame<'a>,
        statement: &Statement,
        span: Span,
    ) -> Result<(), RoutineError> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    self.emit(frame, handle)?;
                }
            }
            Statement::Block(inner) => self.statements(frame, inner)?,
            Statement::Store { pointer, value } => self.store(frame, *pointer, *value, span)?,
            Statement::Call {
                function,
                arguments,
                result,
            } => self.calls(frame, *function, arguments, *result)?,
            Statement::Return { value } => self.returns(frame, *value, span)?,
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                self.keep_from(frame, &[accept, reject])?;
                let asked = self.value(frame, *condition)?;
                self.note_asked(frame, *condition, &asked);
                let values = frame.values.clone();
                let accept = self.block(|builder| builder.statements(frame, accept))?;
                frame.values.clone_from(&values);
                let reject = self.block(|builder| builder.statements(frame, reject))?;
                frame.values = values;
                self.push(ProgramStep::If {
                    condition: asked.slots[0].at,
                    accept,
                    reject,
                });
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => self.loops(frame, body, continuing, *break_if)?,
            Statement::Break => self.push(ProgramStep::Break),
            Statement::Continue => self.push(ProgramStep::Continue),
            Statement::Switch { .. } => {
                return self.refuse("switch is not run here; write if and else");
            }
            Statement::Kill => return self.refuse("discard is for pixels; a routine returns"),
            _ => return self.refuse("this statement is not run here"),
        }
        Ok(())
    }

    fn loops(
        &mut self,
        frame: &mut CallFrame<'a>,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), RoutineError> {
        self.keep_from(frame, &[body, continuing])?;
        let values = frame.values.clone();
        self.costs.push(1);
        let inside = self.block(|builder| builder.statements(frame, body))?;
        let mut last = None;
        let after = self.block(|builder| {
            builder.statements(frame, continuing)?;
            if let Some(condition) = break_if {
                last = Some(builder.value(frame, condition)?.slots[0].at);
            }
            Ok(())
        })?;
        let cost = self.costs.pop().unwrap_or(1);
        frame.values = values;
        self.push(ProgramStep::Loop {
            body: inside,
            continuing: after,
            break_if: last,
            cost,
        });
        Ok(())
    }

    fn store(
        &mut self,
        frame: &mut CallFrame<'a>,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
        span: Span,
    ) -> Result<(), RoutineError> {
        let mut stored = self.value(frame, value)?;
        let expressions = &frame.function.expressions;
        let once = match expressions[pointer] {
            Expression::LocalVariable(local) => match frame.locals.get(&local) {
                Some(Local::Once(_)) => Some(local),
                _ => None,
            },
            _ => None,
        };
        if let Some(local) = once {
            if stored.of.is_some() {
                stored = self.copied(&stored)?;
            }
            frame
                .locals
                .insert(local, Local::Once(Some(stored.clone())));
        } else {
            let variable = self.pointer(frame, pointer)?;
            self.keep(frame, &[variable.storage])?;
            self.put(variable.storage, variable.from, &stored);
        }
        // The reader copies parameters into variables of their names: nothing that the text says.
        let is_copy = matches!(expressions[value], Expression::FunctionArgument(_))
            && matches!(expressions[pointer], Expression::LocalVariable(_));
        if !is_copy {
            self.note_kept(frame, pointer, value, span, &stored);
        }
        Ok(())
    }

    fn calls(
        &mut self,
        frame: &mut CallFrame<'a>,
        called: Handle<Function>,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
    ) -> Result<(), RoutineError> {
        let module = self.module();
        let wanted = &module.functions[called].arguments;
        let mut given = Vec::new();
        for (argument, wanted) in arguments.iter().zip(wanted) {
            let by_pointer = base(module, wanted.ty) != wanted.ty;
            given.push(if by_pointer {
                let variable = self.pointer(frame, *argument)?;
                self.keep(frame, &[variable.storage])?;
                Argument::Variable(variable)
            } else {
                Argument::CompiledValue(self.value(frame, *argument)?)
            });
        }
        let at = self.at;
        let value = self.call_within(called, &given, false, frame.depth + 1)?;
        self.at = at;
        if let (Some(result), Some(value)) = (result, value) {
            frame.values.insert(result, value);
        }
        Ok(())
    }

    fn returns(
        &mut self,
        frame: &mut CallFrame<'a>,
        value: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<(), RoutineError> {
        if let Some(handle) = value {
            let given = self.value(frame, handle)?;
            self.note_given(frame, handle, span, &given);
            match frame.result {
                Some(storage) => self.put(storage, 0, &given),
                None => frame.last = Some(given),
            }
        }
        if !frame.returns_once {
            self.push(ProgramStep::Leave);
        }
        Ok(())
    }

    /// Copies what was read from variables that these blocks write.
    fn keep_from(
        &mut self,
        frame: &mut CallFrame<'a>,
        blocks: &[&Block],
    ) -> Result<(), RoutineError> {
        let mut written = Vec::new();
        for block in blocks {
            writes(block, &mut |pointer| {
                if let Some(variable) = self.pointer_if_any(frame, pointer) {
                    written.push(variable.storage);
                }
            });
        }
        self.keep(frame, &written)
    }

    /// Copies what was read from these variables, for they are about to be written.
    fn keep(&mut self, frame: &mut CallFrame<'a>, written: &[usize]) -> Result<(), RoutineError> {
        let read: Vec<_> = frame
            .values
            .iter()
            .filter(|(_, value)| value.of.is_some_and(|of| written.contains(&of)))
            .map(|(handle, value)| (*handle, value.clone()))
            .collect();
        for (handle, value) in read {
            let copy = self.copied(&value)?;
            frame.values.insert(handle, copy);
        }
        Ok(())
    }

    fn copied(&mut self, value: &CompiledValue) -> Result<CompiledValue, RoutineError> {
        let mut slots = Vec::new();
        for from in &value.slots {
            let to = self.fresh_slot(from.kind)?;
            self.push(ProgramStep::Put { to, from: *from });
            slots.push(to);
        }
        let constancy = match value.constancy {
            Constancy::Flag(flag) => {
                let from = Slot::new(SlotKind::Bool, flag);
                let to = self.fresh_slot(SlotKind::Bool)?;
                self.push(ProgramStep::Put { to, from });
                Constancy::Flag(to.at)
            }
            known => known,
        };
        Ok(CompiledValue {
            slots,
            constancy,
            of: None,
        })
    }

    fn note_kept(
        &mut self,
        frame: &CallFrame<'a>,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
        span: Span,
        stored: &CompiledValue,
    ) {
        let expressions = &frame.function.expressions;
        let text = self.text(span);
        let own = match &expressions[pointer] {
            Expression::LocalVariable(local) => frame.function.local_variables[*local].name.clone(),
            Expression::FunctionArgument(i) => frame.function.arguments[*i as usize].name.clone(),
            _ => None,
        };
        let (name, formula) = match split_assignment(&text) {
            Some((name, formula)) => (name, formula),
            None => match own {
                Some(name) => (name, self.text(expressions.get_span(value))),
                None => return,
            },
        };
        // An unnamed variable is the reader's own, for `?:`.
        if matches!(&expressions[pointer], Expression::LocalVariable(local)
            if frame.function.local_variables[*local].name.is_none())
        {
            return;
        }
        let note = self.note_of(frame, Returned::Kept, Some(name), formula, stored);
        self.note(note);
    }

    fn note_asked(
        &mut self,
        frame: &CallFrame<'a>,
        condition: Handle<Expression>,
        asked: &CompiledValue,
    ) {
        let span = frame.function.expressions.get_span(condition);
        let mut formula = self.text(span);
        if formula.is_empty() {
            "…".clone_into(&mut formula);
        }
        let note = self.note_of(frame, Returned::Asked, None, formula, asked);
        self.note(note);
    }

    fn note_given(
        &mut self,
        frame: &CallFrame<'a>,
        value: Handle<Expression>,
        span: Span,
        given: &CompiledValue,
    ) {
        let mut formula = self.text(frame.function.expressions.get_span(value));
        if formula.is_empty() {
            formula = self.text(span);
        }
        let formula = formula.trim_start_matches("return").trim().to_owned();
        let note = self.note_of(frame, Returned::Given, None, formula, given);
        self.note(note);
    }

    /// A name for a value, in the languages that name values.
    pub fn note_named(
        &mut self,
        frame: &CallFrame<'a>,
        handle: Handle<Expression>,
        value: &CompiledValue,
    ) {
        let Some(name) = frame.function.named_expressions.get(&handle) else {
            return;
        };
        let formula = self.text(frame.function.expressions.get_span(handle));
        let note = self.note_of(frame, Returned::Kept, Some(name.clone()), formula, value);
        self.note(note);
    }

    fn note_of(
        &self,
        frame: &CallFrame<'a>,
        returned: Returned,
        name: Option<String>,
        formula: String,
        value: &CompiledValue,
    ) -> Note {
        Note {
            line: self.source.place(self.at).0,
            name,
            formula,
            returned,
            function: frame.name.clone(),
            slots: value.slots.clone(),
        }
    }

    /// The text of a part, in one line.
    fn text(&self, span: Span) -> String {
        let range = span.to_range().unwrap_or(0..0);
        let text = self.source.code.get(range).unwrap_or("");
        let text: Vec<&str> = text.split_whitespace().collect();
        text.join(" ").trim_end_matches(';').to_owned()
    }
}

/// `x = 2 + y` as name and formula; `x *= y` as `x` and `x * y`.
fn split_assignment(text: &str) -> Option<(String, String)> {
    let bytes = text.as_bytes();
    let at = (0..bytes.len()).find(|&i| {
        let before = i.checked_sub(1).map_or(b' ', |i| bytes[i]);
        let after = bytes.get(i + 1).copied().unwrap_or(b' ');
        bytes[i] == b'=' && after != b'=' && !matches!(before, b'=' | b'<' | b'>' | b'!')
    })?;
    let (left, right) = (text[..at].trim(), text[at + 1..].trim());
    let name = left.trim_end_matches(['+', '-', '*', '/', '%']).trim();
    let name = name.rsplit([' ', ':']).next().unwrap_or(name);
    let sign = left.chars().next_back().filter(|c| "+-*/%".contains(*c));
    let formula = match sign {
        Some(sign) => format!("{name} {sign} {right}"),
        None => right.to_owned(),
    };
    Some((name.to_owned(), formula))
}

/// Whether a body returns only where it ends.
fn returns_at_the_end(body: &Block) -> bool {
    fn count(block: &Block) -> usize {
        block
            .iter()
            .map(|statement| match statement {
                Statement::Return { .. } => 1,
                Statement::Block(inner) => count(inner),
                Statement::If { accept, reject, .. } => count(accept) + count(reject),
                Statement::Loop {
                    body, continuing, ..
                } => count(body) + count(continuing),
                Statement::Switch { cases, .. } => cases.iter().map(|case| count(&case.body)).sum(),
                _ => 0,
            })
            .sum()
    }
    match count(body) {
        0 => true,
        1 => matches!(body.last(), Some(Statement::Return { .. })),
        _ => false,
    }
}

/// What the statements of a block write to, by pointer.
fn writes(block: &Block, found: &mut impl FnMut(Handle<Expression>)) {
    for statement in block {
        match statement {
            Statement::Store { pointer, .. } => found(*pointer),
            Statement::Call { arguments, .. } => arguments.iter().copied().for_each(&mut *found),
            Statement::Block(inner) => writes(inner, found),
            Statement::If { accept, reject, .. } => {
                writes(accept, found);
                writes(reject, found);
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                writes(body, found);
                writes(continuing, found);
            }
            _ => {}
        }
    }
}

/// Variables that are written once and whole, outside branches and loops.
fn written_once(function: &Function) -> HashSet<Handle<LocalVariable>> {
    let root = |mut pointer: Handle<Expression>| loop {
        match function.expressions[pointer] {
            Expression::LocalVariable(local) => break Some(local),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                pointer = base;
            }
            _ => break None,
        }
    };
    let mut counts: HashMap<Handle<LocalVariable>, usize> = HashMap::new();
    writes(&function.body, &mut |pointer| {
        if let Some(local) = root(pointer) {
            *counts.entry(local).or_default() += 1;
        }
    });
    let mut top = Vec::new();
    whole_stores(&function.body, function, &mut top);
    top.into_iter()
        .filter(|local| counts.get(local) == Some(&1))
        .collect()
}

fn whole_stores(block: &Block, function: &Function, found: &mut Vec<Handle<LocalVariable>>) {
    for statement in block {
        match statement {
            Statement::Store { pointer, .. } => {
                if let Expression::LocalVariable(local) = function.expressions[*pointer] {
                    found.push(local);
                }
            }
            Statement::Block(inner) => whole_stores(inner, function, found),
            _ => {}
        }
    }
}
