#include "Elements/FieldExpression.h"

#include "Elements/ExpressionTerm.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace hop
{

namespace
{

using Term = ExpressionTerm;

constexpr int ScalarSize = Term::ScalarSize;
constexpr int VectorSize = Term::VectorSize;

/// An array of the formula, or a component of it.
struct Operand
{
  /// Of its first component, in FieldPoint.
  int first = 0;
  int components = 1;
};

/// Functions of vectors and of several arguments, and those of arrays.
const std::vector<std::string>& otherFunctions()
{
  static const std::vector<std::string> names{ "cross", "curl", "divergence", "dot", "gradient",
    "lambda2", "mag", "magnitude", "max", "min", "norm", "q_criterion" };
  return names;
}

bool isOneOf(const std::string& name, const std::vector<std::string>& names)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// "a, b"
std::string listed(const std::vector<std::string>& names)
{
  std::string all;
  for (const std::string& name : names)
  {
    all += (all.empty() ? "" : ", ") + name;
  }
  return all;
}

/// Parses a formula by recursive descent: a sum of products of powers.
class Parser
{
public:
  Parser(const std::string& text, const std::vector<NamedArray>& arrays)
    : Text(text)
    , Arrays(arrays)
  {
  }

  Term parse()
  {
    Term all = this->sum();
    this->skipSpace();
    if (this->Place < this->Text.size())
    {
      this->fail("nothing is expected there");
    }
    if (all.size != ScalarSize)
    {
      this->fail("the result is a vector; use magnitude() or a component of it");
    }
    return all;
  }

  const std::vector<NamedArray>& used() const { return this->Used; }

private:
  Term sum();
  Term product();
  Term signedPower();
  Term power();
  Term primary();
  Term number();
  Term named();
  Term call(const std::string& name);
  Term callOfArray(const std::string& name);
  Term callOfTwo(const std::string& name, const Term& a, const Term& b);
  Term coordinates(const std::string& name) const;
  Operand operandNamed(const std::string& name);
  bool findArray(const std::string& name, Operand& operand);
  std::string name();

  void skipSpace();
  bool take(char expected);
  void expect(char expected);
  void demand(const Term& term, int size, const std::string& what) const;
  [[noreturn]] void fail(const std::string& reason) const;

  const std::string& Text;
  const std::vector<NamedArray>& Arrays;
  std::vector<NamedArray> Used;
  std::size_t Place = 0;
  int Depth = 0;
};

void Parser::fail(const std::string& reason) const
{
  throw std::invalid_argument("at character " + std::to_string(this->Place + 1) + ": " + reason);
}

void Parser::skipSpace()
{
  while (this->Place < this->Text.size() &&
    std::isspace(static_cast<unsigned char>(this->Text[this->Place])))
  {
    ++this->Place;
  }
}

bool Parser::take(char expected)
{
  this->skipSpace();
  const bool isThere = this->Place < this->Text.size() && this->Text[this->Place] == expected;
  this->Place += isThere;
  return isThere;
}

void Parser::expect(char expected)
{
  if (!this->take(expected))
  {
    this->fail(std::string("'") + expected + "' is missing");
  }
}

void Parser::demand(const Term& term, int size, const std::string& what) const
{
  if (term.size != size)
  {
    this->fail(what);
  }
}

Term Parser::sum()
{
  Term result = this->product();
  for (;;)
  {
    const bool isPlus = this->take('+');
    if (!isPlus && !this->take('-'))
    {
      return result;
    }
    const Term next = this->product();
    this->demand(next, result.size, "scalars and vectors cannot be added");
    result = isPlus ? combined(Operation::Sum, result, next)
                    : combined(Operation::Difference, result, next);
  }
}

Term Parser::product()
{
  Term result = this->signedPower();
  for (;;)
  {
    const bool isTimes = this->take('*');
    if (!isTimes && !this->take('/'))
    {
      return result;
    }
    const Term next = this->signedPower();
    if (next.size != ScalarSize && (!isTimes || result.size != ScalarSize))
    {
      this->fail(
        "vectors can be multiplied and divided by scalars only; there are dot() and cross()");
    }
    result = isTimes ? combined(Operation::Product, result, next)
                     : combined(Operation::Quotient, result, next);
  }
}

Term Parser::signedPower()
{
  bool isNegative = false;
  for (;;)
  {
    if (this->take('-'))
    {
      isNegative = !isNegative;
    }
    else if (!this->take('+'))
    {
      break;
    }
  }
  const Term result = this->power();
  return isNegative ? combined(Operation::Product, constantTerm(-1.0), result) : result;
}

/// Powers are taken from the right: 2^3^2 is 2^9.
Term Parser::power()
{
  Term base = this->primary();
  if (!this->take('^'))
  {
    return base;
  }
  const Term exponent = this->signedPower();
  this->demand(base, ScalarSize, "only scalars have powers");
  this->demand(exponent, ScalarSize, "an exponent has to be a scalar");
  return combined(Operation::Power, base, exponent);
}

Term Parser::primary()
{
  // Formulas nested deeper are a mistake, and would exhaust the stack.
  constexpr int mostDepth = 200;
  if (++this->Depth > mostDepth)
  {
    this->fail("too many parentheses");
  }
  this->skipSpace();
  if (this->Place >= this->Text.size())
  {
    this->fail("a number, a name or '(' is missing");
  }
  Term result;
  const char next = this->Text[this->Place];
  if (this->take('('))
  {
    result = this->sum();
    this->expect(')');
  }
  else if (std::isdigit(static_cast<unsigned char>(next)) || next == '.')
  {
    result = this->number();
  }
  else
  {
    result = this->named();
  }
  --this->Depth;
  return result;
}

Term Parser::number()
{
  const char* start = this->Text.c_str() + this->Place;
  char* end = nullptr;
  const double value = std::strtod(start, &end);
  if (end == start)
  {
    this->fail("that is no number");
  }
  this->Place += end - start;
  return constantTerm(value);
}

/// A name, or what stands between quotation marks.
std::string Parser::name()
{
  if (this->take('"'))
  {
    const std::size_t end = this->Text.find('"', this->Place);
    if (end == std::string::npos)
    {
      this->fail("the second '\"' is missing");
    }
    std::string result = this->Text.substr(this->Place, end - this->Place);
    this->Place = end + 1;
    return result;
  }
  this->skipSpace();
  const std::size_t start = this->Place;
  const auto isOfName = [](char c)
  { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; };
  while (this->Place < this->Text.size() && isOfName(this->Text[this->Place]))
  {
    ++this->Place;
  }
  if (this->Place == start)
  {
    this->fail("a name is missing");
  }
  return this->Text.substr(start, this->Place - start);
}

/// An array, a component, a coordinate or a function.
Term Parser::named()
{
  const std::string name = this->name();
  if (this->take('('))
  {
    return this->call(name);
  }
  Operand operand;
  const bool isArray = this->findArray(name, operand);
  if (!isArray && name.rfind("coords", 0) == 0)
  {
    return this->coordinates(name);
  }
  operand = isArray ? operand : this->operandNamed(name);
  if (operand.components != ScalarSize && operand.components != VectorSize)
  {
    this->fail("'" + name +
      "' is neither a scalar nor a vector of three components; name a component, as " + name +
      "_0");
  }
  return valueTerm(operand.first, operand.components);
}

Term Parser::coordinates(const std::string& name) const
{
  const std::string which = name.substr(6);
  if (which.empty())
  {
    return coordinatesTerm();
  }
  const std::size_t axis = std::string("XYZ").find(which);
  if (which.size() != 1 || axis == std::string::npos)
  {
    this->fail("there is no '" + name + "'; there are coords, coordsX, coordsY and coordsZ");
  }
  return coordinateTerm(static_cast<int>(axis));
}

/// Finds an array by its name, and counts it as used.
bool Parser::findArray(const std::string& name, Operand& operand)
{
  const auto isNamed = [&](const NamedArray& array) { return array.name == name; };
  int first = 0;
  for (const NamedArray& array : this->Used)
  {
    if (isNamed(array))
    {
      operand = { first, array.components };
      return true;
    }
    first += array.components;
  }
  const auto found = std::find_if(this->Arrays.begin(), this->Arrays.end(), isNamed);
  if (found == this->Arrays.end())
  {
    return false;
  }
  this->Used.push_back(*found);
  operand = { first, found->components };
  return true;
}

/// \throw std::invalid_argument if there is neither such an array nor such a component
Operand Parser::operandNamed(const std::string& name)
{
  Operand operand;
  if (this->findArray(name, operand))
  {
    return operand;
  }
  const std::size_t line = name.rfind('_');
  const std::string which = line == std::string::npos ? "" : name.substr(line + 1);
  const std::size_t axis = which.size() == 1 ? std::string("XYZ").find(which) : std::string::npos;
  const bool isNumber = !which.empty() && which.size() < 5 &&
    std::all_of(which.begin(), which.end(), [](unsigned char c) { return std::isdigit(c); });
  if ((axis != std::string::npos || isNumber) && this->findArray(name.substr(0, line), operand))
  {
    const int component = isNumber ? std::stoi(which) : static_cast<int>(axis);
    if (component < operand.components)
    {
      return { operand.first + component, ScalarSize };
    }
  }
  std::string all;
  for (const NamedArray& array : this->Arrays)
  {
    all += (all.empty() ? "'" : ", '") + array.name + "'";
  }
  this->fail(
    "there is no point array '" + name + "', and no function of that name; the arrays: " + all);
}

/// \pre the opening parenthesis has been taken
Term Parser::call(const std::string& name)
{
  const std::vector<std::string> ofScalars = scalarFunctionNames();
  const bool isOfScalar = isOneOf(name, ofScalars);
  if (!isOfScalar && !isOneOf(name, otherFunctions()))
  {
    this->fail("there is no function '" + name + "'; there are " + listed(ofScalars) + ", " +
      listed(otherFunctions()));
  }
  if (isOneOf(name, { "curl", "divergence", "gradient", "lambda2", "q_criterion" }))
  {
    return this->callOfArray(name);
  }
  const Term first = this->sum();
  if (isOfScalar)
  {
    this->expect(')');
    this->demand(first, ScalarSize, name + "() takes a scalar");
    return functionTerm(name, first);
  }
  if (isOneOf(name, { "mag", "magnitude", "norm" }))
  {
    this->expect(')');
    const Term length = lengthOf(first);
    return name != "norm" ? length : combined(Operation::Quotient, first, length);
  }
  this->expect(',');
  const Term second = this->sum();
  this->expect(')');
  return this->callOfTwo(name, first, second);
}

Term Parser::callOfTwo(const std::string& name, const Term& a, const Term& b)
{
  if (name == "min" || name == "max")
  {
    this->demand(a, ScalarSize, name + "() takes two scalars");
    this->demand(b, ScalarSize, name + "() takes two scalars");
    return name == "min" ? combined(Operation::Least, a, b) : combined(Operation::Greatest, a, b);
  }
  this->demand(a, VectorSize, name + "() takes two vectors");
  this->demand(b, VectorSize, name + "() takes two vectors");
  return name == "dot" ? dotOf(a, b) : crossOf(a, b);
}

/// Derivatives: of arrays, not of what is computed from them.
Term Parser::callOfArray(const std::string& name)
{
  const std::string array = this->name();
  if (!this->take(')'))
  {
    this->fail(name +
      "() takes the name of an array or of a component; derivatives of formulas are not supported");
  }
  const Operand operand = this->operandNamed(array);
  if (name == "gradient")
  {
    if (operand.components != ScalarSize && operand.components != VectorSize)
    {
      this->fail("gradient() takes a scalar or a vector of three components");
    }
    return gradientTerm(operand.first, operand.components);
  }
  if (operand.components != VectorSize)
  {
    this->fail(name + "() takes a vector of three components");
  }
  if (name == "curl")
  {
    return curlTerm(operand.first);
  }
  return quantityTerm(name == "divergence" ? Quantity::Divergence
      : name == "lambda2"                  ? Quantity::Lambda2
                                           : Quantity::QCriterion,
    operand.first);
}

} // namespace

FieldExpression::FieldExpression(const std::string& text, const std::vector<NamedArray>& arrays)
{
  Parser parser(text, arrays);
  const Term all = parser.parse();
  this->Function = [all](const FieldPoint& at) { return all.at(at)[0]; };
  this->Bounds = [all](const FieldBounds& in) { return all.within(in)[0]; };
  this->Used = parser.used();
}

} // namespace hop
