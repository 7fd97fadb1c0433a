//! Precedence climbing (Pratt): an operand, then operators as long as they bind tightly enough.
//!
//! | operator | binds | its right side binds |
//! |---|---|---|
//! | + −   | 1 | 2: left-associative |
//! | * /   | 2 | 3: left-associative |
//! | sign  |   | 3: −x^2 = −(x^2) |
//! | ^     | 3 | 3: right-associative |
//!
//! Parentheses, signs and exponents nest by recursion, at most [`DEPTH`] deep; a chain of operators
//! of one kind is a loop and may be as long as the text.

use std::f64::consts::PI;
use std::ops::Range;

use super::lexer::{Kind, Lexer, Token};
use super::operation::{Binary, FUNCTIONS, Function, Unary};
use super::program::{Builder, Program};
use super::step::{STACK, Step, Variable};
use super::{ParseError, Variables};

const DEPTH: usize = 64;
const LENGTH: usize = 4096;
const SIGNED: u8 = 3;

/// Reads the whole of `text`.
pub(super) fn parse(text: &str, variables: Variables) -> Result<Program, ParseError> {
    if text.len() > LENGTH {
        let message = format!("{} bytes, an expression has at most {LENGTH}", text.len());
        return Err(ParseError { message, span: 0..text.len(), hint: None });
    }
    let mut lexer = Lexer::new(text);
    let token = lexer.next()?;
    let program = Builder::default();
    let mut parser = Parser { text, variables, lexer, token, previous: 0..0, depth: 0, program };
    parser.expression(0)?;
    if parser.token.kind != Kind::End {
        return Err(parser.unexpected("the end"));
    }
    let program = parser.program.finish();
    match program.value() {
        Some(value) if !value.is_finite() => {
            let message = format!("its value is {value}, not a finite number");
            Err(ParseError { message, span: 0..text.len(), hint: None })
        }
        _ => Ok(program),
    }
}

struct Parser<'a> {
    text: &'a str,
    variables: Variables,
    lexer: Lexer<'a>,
    token: Token,
    /// Where the token before `token` stands.
    previous: Range<usize>,
    depth: usize,
    program: Builder,
}

impl Parser<'_> {
    /// Operators that bind at least as tightly as `minimum`, with their operands.
    fn expression(&mut self, minimum: u8) -> Result<(), ParseError> {
        self.operand()?;
        while let Some((operation, binds, right)) = operator(self.token.kind) {
            if binds < minimum {
                break;
            }
            self.advance()?;
            match operation {
                Binary::Power => self.nested(right)?,
                _ => self.expression(right)?,
            }
            self.program.push(Step::Binary(operation));
        }
        Ok(())
    }

    /// An expression one level deeper.
    fn nested(&mut self, minimum: u8) -> Result<(), ParseError> {
        if self.depth == DEPTH {
            return Err(self.too_deep());
        }
        self.depth += 1;
        self.expression(minimum)?;
        self.depth -= 1;
        Ok(())
    }

    fn operand(&mut self) -> Result<(), ParseError> {
        match self.token.kind {
            Kind::Number(value) => self.push(Step::Constant(value)),
            Kind::Name => self.name(),
            Kind::Symbol(sign @ ('+' | '-')) => {
                self.advance()?;
                self.nested(SIGNED)?;
                if sign == '-' {
                    self.program.push(Step::Unary(Unary::Negate));
                }
                Ok(())
            }
            Kind::Symbol('(') => {
                self.advance()?;
                self.nested(0)?;
                self.expect(')')
            }
            Kind::Symbol(_) | Kind::End => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    /// A variable, `pi` or a function call.
    fn name(&mut self) -> Result<(), ParseError> {
        match &self.text[self.token.span.clone()] {
            "pi" => self.push(Step::Constant(PI)),
            "x" => self.push(Step::Variable(Variable::X)),
            "y" => self.push(Step::Variable(Variable::Y)),
            "t" if self.variables == Variables::SpaceTime => self.push(Step::Variable(Variable::T)),
            name => match FUNCTIONS.iter().find(|(known, _)| *known == name) {
                Some(&(_, function)) => self.call(function),
                None => Err(self.unknown(name)),
            },
        }
    }

    fn call(&mut self, function: Function) -> Result<(), ParseError> {
        let name = self.token.span.clone();
        self.advance()?;
        self.expect('(')?;
        self.nested(0)?;
        let mut count = 1;
        while self.token.kind == Kind::Symbol(',') {
            count += 1;
            match function {
                Function::Two(operation) if count == 2 => self.argument(operation)?,
                Function::Fold(operation) => self.argument(operation)?,
                _ => return Err(self.wrong_count(name, function)),
            }
        }
        match function {
            Function::One(operation) => self.program.push(Step::Unary(operation)),
            _ if count < 2 => return Err(self.wrong_count(name, function)),
            _ => None,
        };
        self.expect(')')
    }

    /// `, argument`, joined to the one before it.
    fn argument(&mut self, operation: Binary) -> Result<(), ParseError> {
        self.advance()?;
        self.nested(0)?;
        self.program.push(Step::Binary(operation));
        Ok(())
    }

    fn push(&mut self, operand: Step) -> Result<(), ParseError> {
        self.program.push(operand).ok_or_else(|| self.too_deep())?;
        self.advance()
    }

    fn advance(&mut self) -> Result<(), ParseError> {
        let next = self.lexer.next()?;
        self.previous = std::mem::replace(&mut self.token, next).span;
        Ok(())
    }

    fn expect(&mut self, symbol: char) -> Result<(), ParseError> {
        if self.token.kind != Kind::Symbol(symbol) {
            return Err(self.unexpected(&format!("`{symbol}`")));
        }
        self.advance()
    }

    /// The token cannot stand here; two operands side by side are a forgotten `*`.
    fn unexpected(&self, expected: &str) -> ParseError {
        let span = self.token.span.clone();
        let found = &self.text[span.clone()];
        let before = &self.text[self.previous.clone()];
        let after_operand =
            before.ends_with(|c: char| c.is_ascii_alphanumeric() || ".)_".contains(c));
        let (message, hint) = match self.token.kind {
            Kind::End => (format!("expected {expected}, found the end"), None),
            Kind::Name if after_operand && self.may_be_unit(found) => (
                format!("`{found}` is no variable"),
                Some(format!(
                    "numbers have no units here, and products a `*`: write `{before}`, in units that go together"
                )),
            ),
            Kind::Number(_) | Kind::Name | Kind::Symbol('(')
                if expected != "`(`" && after_operand =>
            {
                (
                    format!("expected an operator before `{found}`"),
                    Some(format!("write `{before}*{found}`")),
                )
            }
            Kind::Symbol(',') if self.is_decimal_comma() => (
                format!("expected {expected}, found `,`"),
                Some("numbers are written with a point, as in 2.5".to_owned()),
            ),
            Kind::Symbol('*') if before == "*" => {
                ("unexpected `**`".to_owned(), Some("a power is written `^`".to_owned()))
            }
            _ => (format!("expected {expected}, found `{found}`"), None),
        };
        ParseError { message, span, hint }
    }

    /// Whether the comma at hand stands between digits.
    fn is_decimal_comma(&self) -> bool {
        let before = &self.text[..self.token.span.start];
        let after = &self.text[self.token.span.end..];
        let is_digit = |c: char| c.is_ascii_digit();
        before.ends_with(is_digit) && after.starts_with(is_digit)
    }

    /// Whether a name is made of letters and means nothing here.
    fn may_be_unit(&self, name: &str) -> bool {
        let is_variable = self.variables.names().contains(&name);
        let is_function = FUNCTIONS.iter().any(|(function, _)| *function == name);
        !(is_variable || is_function || name == "pi") && name.chars().all(char::is_alphabetic)
    }

    fn unknown(&self, name: &str) -> ParseError {
        let variables = self.variables.names().join(", ");
        let functions = FUNCTIONS.map(|(name, _)| name).join(" ");
        ParseError {
            message: format!("unknown name `{name}`"),
            span: self.token.span.clone(),
            hint: Some(format!("known here: {variables}, pi and the functions {functions}")),
        }
    }

    fn wrong_count(&self, name: Range<usize>, function: Function) -> ParseError {
        let count = match function {
            Function::One(_) => "one argument",
            Function::Two(_) => "two arguments",
            Function::Fold(_) => "two arguments or more",
        };
        let message = format!("`{}` takes {count}", &self.text[name.clone()]);
        ParseError { message, span: name, hint: None }
    }

    fn too_deep(&self) -> ParseError {
        ParseError {
            message: format!("nested deeper than {DEPTH} levels or {STACK} waiting operands"),
            span: self.token.span.clone(),
            hint: Some("write it with fewer parentheses".to_owned()),
        }
    }
}

/// The operation, how tightly it binds and how tightly its right side must.
fn operator(kind: Kind) -> Option<(Binary, u8, u8)> {
    match kind {
        Kind::Symbol('+') => Some((Binary::Add, 1, 2)),
        Kind::Symbol('-') => Some((Binary::Subtract, 1, 2)),
        Kind::Symbol('*') => Some((Binary::Multiply, 2, 3)),
        Kind::Symbol('/') => Some((Binary::Divide, 2, 3)),
        Kind::Symbol('^') => Some((Binary::Power, 3, SIGNED)),
        _ => None,
    }
}
