#include "SurfaceBoxes.h"

#include "Bisection.h"
#include "BoundaryTest.h"
#include "MonotoneTest.h"
#include "ProxyPolygons.h"
#include "SheetPair.h"
#include "TouchTest.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <set>

namespace hop
{
namespace
{

/// A piece of an element: its coefficients, of which the last is that of F - c (of w (F - c), if
/// rational), its weights, if rational, and its corners in the element's reference space.
struct Piece
{
  std::vector<Coefficient> coefficients;
  std::vector<double> weights;
  std::vector<glm::dvec3> corners;
  int bisections = 0;
  /// Which of the parts of its element it is, or lies in: a one, then a bit for each of the first
  /// PartBisections halvings.
  int part = 1;
  /// How the field rises, if the surface in it is known to be one sheet.
  Monotony sheet = Monotony::None;

  bool certified() const { return this->sheet != Monotony::None; }
};

constexpr Degrees cornerDegrees{ 1, 1, 1 };

/// A direction in which pieces can be halved: lattice lines, and the places of coefficients along its edges.
struct Direction
{
  LatticeLines coefficients;
  LatticeLines corners;
  std::vector<std::vector<int>> edges;
};

std::vector<std::vector<int>> edgeLines(
  Domain domain, const Degrees& degrees, const LatticePoint& direction)
{
  std::vector<std::vector<int>> lines;
  for (const auto& [first, last] : edgesAlong(domain, direction))
  {
    std::vector<int>& line = lines.emplace_back();
    for (LatticePoint p = cornerLatticePoint(domain, degrees, first); inLattice(domain, degrees, p);
         p = { p.i + direction.i, p.j + direction.j, p.k + direction.k })
    {
      line.push_back(coefficientIndex(domain, degrees, p));
    }
  }
  return lines;
}

/// Levels of so many pieces keep threads busy, whichever of them take long.
constexpr std::size_t manyPieces = 256;
/// Fewer elements than this are split one after the other, each in threads.
constexpr std::size_t fewElements = 16;
/// Pieces are looked at every so many halvings, as soon as each axis had so many, for whether they touch the
/// isovalue only.
constexpr int halvingsOfAllAxes = 3;
constexpr int firstTouchBisections = 9;
/// Pieces that are undecided after so many halvings may hold two sheets close to each other.
constexpr int pairBisections = 9;
/// As many pieces with one sign at their corners are normal in an element that the surface crosses, and
/// where nothing tells that it does. None are after so many halvings.
constexpr int fewOneSided = 1024;
constexpr int fewOneSidedWithoutSurface = 64;
constexpr int smallBisections = 18;
/// As many pieces given up are boxes of their own.
constexpr std::size_t fewLeft = 16;

using ReportShare = std::function<void(double)>;

void report(const ReportShare& found, double share)
{
  if (found)
  {
    found(share);
  }
}

/// How much of an element's surface has its boxes: the pieces of a level that hold surface are taken for
/// equal parts of what the levels before have left.
class FoundShare
{
public:
  explicit FoundShare(const ReportShare& found)
    : Found(found)
  {
  }

  void beginLevel(std::size_t pieces)
  {
    this->Before = this->now();
    this->Pieces = pieces;
    this->Finished = 0;
    this->Empty = 0;
  }

  /// A piece holds no surface, or all that is in it has its boxes. May be called from several threads.
  void closePiece(bool isEmpty)
  {
    ++(isEmpty ? this->Empty : this->Finished);
    report(this->Found, this->now());
  }

private:
  double now() const
  {
    const std::size_t holding = this->Pieces - this->Empty;
    return holding == 0 ? this->Before
                        : this->Before +
        (1.0 - this->Before) * static_cast<double>(this->Finished) / static_cast<double>(holding);
  }

  const ReportShare& Found;
  double Before = 0.0;
  std::size_t Pieces = 0;
  std::atomic<std::size_t> Finished{ 0 };
  std::atomic<std::size_t> Empty{ 0 };
};

/// One that the largest of some values is 1 to 2 times; 1 if all are zero.
double powerOfTwoNear(const std::array<double, MaximumCorners>& values)
{
  double largest = 0.0;
  for (const double value : values)
  {
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
}

class ElementSplitter
{
public:
  ElementSplitter(
    const ElementMesh& mesh, double isovalue, const std::function<bool(const SurfaceBox&)>& isSmall)
    : Mesh(mesh)
    , Isovalue(isovalue)
    , IsSmall(isSmall)
  {
  }

  /// Appends the boxes of an element.
  void split(int element, const ParallelFor& parallelFor, const ReportShare& found,
    std::vector<SurfaceBox>& boxes)
  {
    this->begin(element);
    FoundShare share(found);
    // Level by level, so that the limit on pieces cuts all of the element at the same size.
    std::vector<Piece> level{ this->wholeElement() };
    if (!isFinite(level.front()))
    {
      return;
    }
    this->ElementSlack = this->slackOf(rangeOf(level.front()));
    const std::size_t before = boxes.size();
    Left left;
    while (!level.empty())
    {
      const GivenUp givenUp = this->givenUp(level, boxes.size() > before);
      share.beginLevel(level.size());
      std::vector<Outcome> outcomes = this->decideAll(element, level, givenUp, parallelFor, share);
      level = sortOut(std::move(level), std::move(outcomes), boxes, left);
    }
    this->addLeft(element, left, boxes);
  }

private:
  /// What becomes of a piece: nothing, boxes, one that is left undecided, or two halves, of which it
  /// keeps the first.
  struct Outcome
  {
    std::vector<SurfaceBox> boxes;
    bool isHalved = false;
    bool isLeft = false;
    Piece second;
  };

  /// Boxes of pieces that were left undecided, and the parts of the element that they lie in.
  struct Left
  {
    std::vector<SurfaceBox> boxes;
    std::set<int> parts;
  };

  /// Which undecided pieces of a level are not halved any more.
  struct GivenUp
  {
    bool all = false;
    bool touching = false;
    bool missing = false;
  };

  /// Where a field only touches the isovalue its pieces stay undecided, on and on, and have one sign
  /// at their corners.
  /// \param isCrossed whether there are boxes already
  GivenUp givenUp(const std::vector<Piece>& level, bool isCrossed) const
  {
    GivenUp result;
    result.all = this->undecided(level) > this->mostUndecided(level.front());
    const int bisections = level.front().bisections;
    if (bisections < firstTouchBisections || bisections % halvingsOfAllAxes != 0)
    {
      return result;
    }
    int oneSided = 0;
    for (const Piece& piece : level)
    {
      const bool isOneSided = !piece.certified() && this->signAtCorners(piece) != 0.0;
      isCrossed = isCrossed || !isOneSided;
      oneSided += isOneSided && this->mayHoldSurface(piece);
    }
    const bool areSmall = bisections >= smallBisections;
    result.touching = areSmall || oneSided > (isCrossed ? fewOneSided : fewOneSidedWithoutSurface);
    result.missing = areSmall && oneSided > fewOneSided;
    return result;
  }

  std::ptrdiff_t mostUndecided(const Piece& piece) const
  {
    const std::size_t bytes =
      piece.coefficients.size() * sizeof(Coefficient) + piece.weights.size() * sizeof(double);
    return piece.bisections >= LongBisections
      ? MaximumLongPieces
      : std::min<std::ptrdiff_t>(MaximumPieces, MaximumPieceBytes / bytes);
  }

  /// Whether a piece that is not certified is not worth halving.
  bool isGivenUp(const Piece& piece, const GivenUp& givenUp) const
  {
    if (this->isZero(piece))
    {
      return true;
    }
    const double sign = givenUp.touching ? this->signAtCorners(piece) : 0.0;
    if (sign == 0.0 || this->Monotone.rises(valuesOf(piece)))
    {
      return false;
    }
    const Approach approach = approachToZero(this->formOf(piece), sign);
    return approach == Approach::Touches || (givenUp.missing && approach == Approach::Misses);
  }

  std::vector<Outcome> decideAll(int element, std::vector<Piece>& level, const GivenUp& givenUp,
    const ParallelFor& parallelFor, FoundShare& share) const
  {
    // Pieces of high degree are large: once there are enough for all threads, certified ones are
    // followed to their boxes one by one.
    const bool toTheEnd = level.size() >= manyPieces;
    std::vector<Outcome> outcomes(level.size());
    runParallel(parallelFor, static_cast<std::ptrdiff_t>(level.size()),
      [&](std::ptrdiff_t begin, std::ptrdiff_t end)
      {
        for (std::ptrdiff_t n = begin; n < end; ++n)
        {
          outcomes[n] = this->decide(element, level[n], givenUp, toTheEnd);
          if (!outcomes[n].isHalved)
          {
            share.closePiece(outcomes[n].boxes.empty());
          }
        }
      });
    return outcomes;
  }

  /// \return the next level
  static std::vector<Piece> sortOut(std::vector<Piece> level, std::vector<Outcome> outcomes,
    std::vector<SurfaceBox>& boxes, Left& left)
  {
    std::vector<Piece> next;
    for (std::size_t n = 0; n < level.size(); ++n)
    {
      Outcome& outcome = outcomes[n];
      std::vector<SurfaceBox>& list = outcome.isLeft ? left.boxes : boxes;
      list.insert(list.end(), outcome.boxes.begin(), outcome.boxes.end());
      if (outcome.isLeft)
      {
        left.parts.insert(level[n].part);
      }
      if (outcome.isHalved)
      {
        next.push_back(std::move(outcome.second));
        next.push_back(std::move(level[n]));
      }
    }
    return next;
  }

  /// Few boxes that were left undecided as they are, in place of many the parts that they lie in.
  void addLeft(int element, const Left& left, std::vector<SurfaceBox>& boxes) const
  {
    if (left.boxes.size() <= fewLeft)
    {
      boxes.insert(boxes.end(), left.boxes.begin(), left.boxes.end());
      return;
    }
    for (const int part : left.parts)
    {
      boxes.push_back(this->boxOfPart(element, part));
    }
  }

  Outcome decide(int element, Piece& piece, const GivenUp& givenUp, bool toTheEnd) const
  {
    Outcome outcome;
    if (!this->mayHoldSurface(piece))
    {
      return outcome;
    }
    piece.sheet = piece.certified() ? piece.sheet : this->sheetOf(piece);
    if (piece.certified() && toTheEnd)
    {
      this->followToBoxes(element, piece, outcome.boxes);
      return outcome;
    }
    if (!(piece.certified() ? this->finishCertified(piece, element, outcome.boxes)
                            : this->finishUndecided(piece, element, givenUp, outcome)))
    {
      outcome.isHalved = true;
      outcome.second = this->halve(piece);
    }
    return outcome;
  }

  /// \return whether there is nothing to halve
  bool finishCertified(const Piece& piece, int element, std::vector<SurfaceBox>& boxes) const
  {
    const SurfaceBox box = this->boxOf(piece, element);
    const bool isFinished = piece.bisections == MaximumBisections || this->IsSmall(box);
    if (isFinished)
    {
      boxes.push_back(box);
    }
    return isFinished;
  }

  /// \return whether there is nothing to halve
  bool finishUndecided(
    const Piece& piece, int element, const GivenUp& givenUp, Outcome& outcome) const
  {
    const bool isDeep = piece.bisections == MaximumBisections;
    const bool isLast = isDeep || givenUp.all;
    const bool mayTouch = this->isGivenUp(piece, givenUp);
    const auto pair = this->sheetPairIn(piece, element, isLast || mayTouch);
    if (pair)
    {
      if (isLast || pair->isFlat())
      {
        this->addSheetPair(piece, element, *pair, outcome.boxes);
        return true;
      }
      return false;
    }
    if (!isLast && !mayTouch)
    {
      return false;
    }
    SurfaceBox box = this->boxOf(piece, element);
    box.certified = !mayTouch && this->Monotone.rises(valuesOf(piece));
    outcome.isLeft = mayTouch || (!box.certified && !box.straddles && !isDeep);
    outcome.boxes.push_back(box);
    return true;
  }

  /// Splits a certified piece until its parts are small enough.
  void followToBoxes(int element, Piece& piece, std::vector<SurfaceBox>& boxes) const
  {
    if (!this->mayHoldSurface(piece))
    {
      return;
    }
    if (!this->finishCertified(piece, element, boxes))
    {
      Piece second = this->halve(piece);
      this->followToBoxes(element, second, boxes);
      this->followToBoxes(element, piece, boxes);
    }
  }

  void begin(int element)
  {
    const BernsteinForm form = this->Mesh.form(element);
    const bool sameKind = !this->CornerPlaces.empty() && form.domain == this->Form.domain &&
      form.degrees == this->Form.degrees;
    this->Form = form;
    if (sameKind)
    {
      return;
    }
    this->Monotone = MonotoneTest(form.domain, form.degrees);
    this->Directions.clear();
    for (const LatticePoint& direction : facts(form.domain).edgeDirections)
    {
      this->Directions.push_back(
        { { form.domain, form.degrees, direction }, { form.domain, cornerDegrees, direction },
          edgeLines(form.domain, form.degrees, direction) });
    }
    this->Boundary = BoundaryTest(form.domain, form.degrees);
    this->CornerPlaces.clear();
    this->CornerOrder.clear();
    const auto placeOf = [&form](int corner, const Degrees& degrees)
    {
      return coefficientIndex(
        form.domain, degrees, cornerLatticePoint(form.domain, degrees, corner));
    };
    for (int c = 0; c < static_cast<int>(facts(form.domain).corners.size()); ++c)
    {
      this->CornerPlaces.push_back(placeOf(c, form.degrees));
      this->CornerOrder.push_back(placeOf(c, cornerDegrees));
    }
  }

  Piece wholeElement() const
  {
    Piece piece;
    const int count = coefficientCount(this->Form.domain, this->Form.degrees);
    piece.coefficients.assign(this->Form.coefficients, this->Form.coefficients + count);
    if (this->Form.weights)
    {
      piece.weights.assign(this->Form.weights, this->Form.weights + count);
    }
    for (int i = 0; i < count; ++i)
    {
      piece.coefficients[i].w -= this->Isovalue * (this->Form.weights ? piece.weights[i] : 1.0);
    }
    for (const LatticePoint& point : latticePoints(this->Form.domain, cornerDegrees))
    {
      piece.corners.push_back(latticePosition(cornerDegrees, point).xyz);
    }
    return piece;
  }

  static bool isFinite(const Piece& piece)
  {
    return std::all_of(piece.coefficients.begin(), piece.coefficients.end(),
      [](const Coefficient& c) { return std::isfinite(c.x + c.y + c.z + c.w); });
  }

  static std::ptrdiff_t undecided(const std::vector<Piece>& pieces)
  {
    return std::count_if(
      pieces.begin(), pieces.end(), [](const Piece& piece) { return !piece.certified(); });
  }

  BernsteinForm formOf(const Piece& piece) const
  {
    return { this->Form.domain, this->Form.degrees, piece.coefficients.data(),
      piece.weights.empty() ? nullptr : piece.weights.data() };
  }

  /// Of the coefficients of F - c.
  static Range rangeOf(const Piece& piece)
  {
    const auto [lowest, highest] =
      std::minmax_element(piece.coefficients.begin(), piece.coefficients.end(),
        [](const Coefficient& a, const Coefficient& b) { return a.w < b.w; });
    return { lowest->w, highest->w };
  }

  double slackOf(const Range& range) const
  {
    return RoundingShare *
      (std::max(std::abs(range.lower), std::abs(range.upper)) + std::abs(this->Isovalue));
  }

  bool mayHoldSurface(const Piece& piece) const
  {
    const Range range = rangeOf(piece);
    const double slack = this->slackOf(range);
    return range.lower <= slack && range.upper >= -slack;
  }

  /// Whether the field is nothing but the isovalue, to its rounding errors in the element.
  bool isZero(const Piece& piece) const
  {
    const Range range = rangeOf(piece);
    return range.lower >= -this->ElementSlack && range.upper <= this->ElementSlack;
  }

  /// 1 or -1 if corners have that sign, or are at zero; 0 if they have both.
  double signAtCorners(const Piece& piece) const
  {
    double lowest = 0.0;
    double highest = 0.0;
    for (const int place : this->CornerPlaces)
    {
      lowest = std::min(lowest, piece.coefficients[place].w);
      highest = std::max(highest, piece.coefficients[place].w);
    }
    return lowest >= -this->ElementSlack ? 1.0 : highest <= this->ElementSlack ? -1.0 : 0.0;
  }

  /// All of a part of the element, in place of what in it was left undecided: nothing is known of what the
  /// surface does there.
  SurfaceBox boxOfPart(int element, int part) const
  {
    int bits = 0;
    while (part >> (bits + 1) != 0)
    {
      ++bits;
    }
    Piece piece = this->wholeElement();
    while (bits-- > 0)
    {
      Piece second = this->halve(piece);
      if ((part >> bits) & 1)
      {
        piece = std::move(second);
      }
    }
    SurfaceBox box = this->boxOf(piece, element);
    box.straddles = false;
    box.values.fill(1.0f);
    return box;
  }

  SurfaceBox boxOf(const Piece& piece, int element) const
  {
    SurfaceBox box = this->boxAround(piece, element, this->cornerValues(piece));
    box.certified = piece.certified();
    // Parts of a piece whose field rises weakly may be away from where it stands still.
    box.weakly =
      piece.sheet == Monotony::Weak && this->Monotone.monotony(valuesOf(piece)) != Monotony::Strict;
    box.mayBeThin = piece.sheet == Monotony::Weak;
    int lowest = 0;
    int highest = 0;
    const auto value = [&](int c) { return piece.coefficients[this->CornerPlaces[c]].w; };
    for (int c = 1; c < static_cast<int>(this->CornerPlaces.size()); ++c)
    {
      lowest = value(c) < value(lowest) ? c : lowest;
      highest = value(c) > value(highest) ? c : highest;
    }
    box.straddles = value(lowest) < 0.0 && value(highest) > 0.0;
    box.ends = { { { this->corner(piece, lowest) }, { this->corner(piece, highest) } } };
    return box;
  }

  SurfaceBox boxAround(
    const Piece& piece, int element, const std::array<double, MaximumCorners>& values) const
  {
    SurfaceBox box;
    box.middle = { element, middle(piece) };
    box.size = this->worldSize(piece);
    box.valueUnit = powerOfTwoNear(values);
    for (int c = 0; c < static_cast<int>(this->CornerPlaces.size()); ++c)
    {
      box.referenceRadius =
        std::max(box.referenceRadius, glm::distance(this->corner(piece, c), box.middle.u.xyz));
      box.corners[c] = glm::vec3(this->corner(piece, c));
      box.values[c] = static_cast<float>(values[c] / box.valueUnit);
    }
    return box;
  }

  /// Two sheets close to each other in a piece that is small or will not be halved.
  std::optional<SheetPair> sheetPairIn(const Piece& piece, int element, bool isLast) const
  {
    const bool isReady =
      isLast || (piece.bisections >= pairBisections && this->IsSmall(this->boxOf(piece, element)));
    return isReady ? findSheetPair(this->formOf(piece), this->Monotone, this->ElementSlack)
                   : std::nullopt;
  }

  /// The box of a piece for each of two sheets that is in it, with its values.
  void addSheetPair(
    const Piece& piece, int element, const SheetPair& pair, std::vector<SurfaceBox>& boxes) const
  {
    for (const SheetPair::Sheet& sheet : pair.sheets)
    {
      const auto [least, most] =
        std::minmax_element(sheet.values.begin(), sheet.values.begin() + this->CornerPlaces.size());
      if (*least <= 0.0 && *most >= 0.0)
      {
        SurfaceBox& box = boxes.emplace_back(this->boxAround(piece, element, sheet.values));
        box.certified = pair.isFlat();
        box.straddles = true;
        box.ends = { this->inElement(piece, pair.between),
          this->inElement(piece, 2.0 * sheet.place - pair.between) };
        if (pair.outside < 0.0)
        {
          std::swap(box.ends[0], box.ends[1]);
        }
        box.ownValues = static_cast<float>(sheet.reach / box.valueUnit);
        box.middle.u = proxyMiddle(this->Form.domain, box);
      }
    }
  }

  /// F - c at the corners of a piece.
  std::array<double, MaximumCorners> cornerValues(const Piece& piece) const
  {
    std::array<double, MaximumCorners> values{};
    for (std::size_t c = 0; c < this->CornerPlaces.size(); ++c)
    {
      const int place = this->CornerPlaces[c];
      values[c] =
        piece.coefficients[place].w / (piece.weights.empty() ? 1.0 : piece.weights[place]);
    }
    return values;
  }

  /// A place in a piece, of its own reference coordinates, in the element's.
  ReferencePoint inElement(const Piece& piece, const glm::dvec3& u) const
  {
    const auto cornerAt = [&](const LatticePoint& point)
    { return piece.corners[coefficientIndex(this->Form.domain, cornerDegrees, point)]; };
    const glm::dvec3 origin = cornerAt({ 0, 0, 0 });
    return { origin + u.x * (cornerAt({ 1, 0, 0 }) - origin) +
      u.y * (cornerAt({ 0, 1, 0 }) - origin) + u.z * (cornerAt({ 0, 0, 1 }) - origin) };
  }

  /// A corner of the piece in the element's reference space.
  const glm::dvec3& corner(const Piece& piece, int c) const
  {
    return piece.corners[this->CornerOrder[c]];
  }

  static std::vector<double> valuesOf(const Piece& piece)
  {
    std::vector<double> values;
    values.reserve(piece.coefficients.size());
    for (const Coefficient& c : piece.coefficients)
    {
      values.push_back(c.w);
    }
    return values;
  }

  /// How the field rises, if the surface is known to be one sheet: it has corners of both signs, or at zero,
  /// and rises along some direction. On the rim of the element there must also be one piece only: another one
  /// could be all there is of a component.
  Monotony sheetOf(const Piece& piece) const
  {
    const std::vector<double> values = valuesOf(piece);
    double largest = std::abs(this->Isovalue);
    for (const double value : values)
    {
      largest = std::max(largest, std::abs(value));
    }
    const double slack = RoundingShare * largest;
    const auto atCorner = [&](const auto& holds)
    {
      return std::any_of(this->CornerPlaces.begin(), this->CornerPlaces.end(),
        [&](int corner) { return holds(values[corner]); });
    };
    if (!atCorner([slack](double value) { return value >= -slack; }) ||
      !atCorner([slack](double value) { return value <= slack; }))
    {
      return Monotony::None;
    }
    const bool mayHoldMore = piece.bisections < MaximumRimBisections && this->onRim(piece);
    const Monotony monotony = this->Monotone.monotony(values);
    return monotony != Monotony::None && mayHoldMore && !this->Boundary.crossedOnce(values, slack)
      ? Monotony::None
      : monotony;
  }

  /// Whether the piece has a face on one of the element's.
  bool onRim(const Piece& piece) const
  {
    constexpr double rounding = 1e-12;
    const auto& faces = facts(this->Form.domain).faces;
    return std::any_of(faces.begin(), faces.end(),
      [&](const Face& face)
      {
        return std::count_if(piece.corners.begin(), piece.corners.end(),
                 [&](const glm::dvec3& u)
                 { return glm::dot(face.inward.xyz, u) + face.offset < rounding; }) >= 3;
      });
  }

  double worldSize(const Piece& piece) const
  {
    const BernsteinForm form = this->formOf(piece);
    glm::dvec3 lower(controlPoint(form, 0));
    glm::dvec3 upper = lower;
    for (int i = 1; i < static_cast<int>(piece.coefficients.size()); ++i)
    {
      const glm::dvec3 x(controlPoint(form, i));
      lower = glm::min(lower, x);
      upper = glm::max(upper, x);
    }
    return glm::distance(lower, upper);
  }

  static ReferencePoint middle(const Piece& piece)
  {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : piece.corners)
    {
      sum += corner;
    }
    return { sum / static_cast<double>(piece.corners.size()) };
  }

  /// Halves the piece across its longest direction; it keeps the first half, the second is returned.
  Piece halve(Piece& piece) const
  {
    const Direction& direction = this->Directions[this->longestDirection(piece)];
    Piece second;
    direction.coefficients.bisect(piece.coefficients, second.coefficients);
    if (!piece.weights.empty())
    {
      direction.coefficients.bisect(piece.weights, second.weights);
    }
    direction.corners.bisect(piece.corners, second.corners);
    second.bisections = ++piece.bisections;
    second.part = piece.part;
    second.sheet = piece.sheet;
    if (piece.bisections <= PartBisections)
    {
      piece.part = 2 * piece.part;
      second.part = 2 * second.part + 1;
    }
    return second;
  }

  /// The direction whose edges are longest in world space, along their control points: the ends of an edge that
  /// closes on itself are in one place.
  std::size_t longestDirection(const Piece& piece) const
  {
    const BernsteinForm form = this->formOf(piece);
    std::size_t longest = 0;
    double longestSquared = -1.0;
    for (std::size_t d = 0; d < this->Directions.size(); ++d)
    {
      for (const std::vector<int>& edge : this->Directions[d].edges)
      {
        double sum = 0.0;
        for (std::size_t n = 1; n < edge.size(); ++n)
        {
          const glm::dvec3 step(controlPoint(form, edge[n]) - controlPoint(form, edge[n - 1]));
          sum += glm::dot(step, step);
        }
        // As if all steps were of one length.
        const double squared = sum * static_cast<double>(edge.size() - 1);
        if (squared > longestSquared)
        {
          longest = d;
          longestSquared = squared;
        }
      }
    }
    return longest;
  }

  const ElementMesh& Mesh;
  double Isovalue;
  const std::function<bool(const SurfaceBox&)>& IsSmall;
  BernsteinForm Form;
  /// What rounding errors of values may amount to.
  double ElementSlack = 0.0;
  MonotoneTest Monotone{ Domain::Hexahedron, cornerDegrees };
  BoundaryTest Boundary{ Domain::Hexahedron, cornerDegrees };
  /// For each corner its place among coefficients, and among corners of pieces.
  std::vector<int> CornerPlaces;
  std::vector<int> CornerOrder;
  std::vector<Direction> Directions;
};

glm::dmat3 symmetric(const std::array<Coefficient, 6>& second)
{
  return { second[0].w, second[1].w, second[2].w, second[1].w, second[3].w, second[4].w,
    second[2].w, second[4].w, second[5].w };
}

} // namespace

bool isAtBox(const SurfaceBox& box, const Location& location)
{
  return location.element == box.middle.element &&
    glm::distance(location.u.xyz, box.middle.u.xyz) <= box.referenceRadius;
}

Location findBetweenEnds(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, std::int64_t& evaluations)
{
  constexpr int mostSteps = 20;
  constexpr double nearEnough = 1e-3;
  const BernsteinForm form = mesh.form(box.middle.element);
  const auto at = [&](double t)
  { return ReferencePoint{ glm::mix(box.ends[0].xyz, box.ends[1].xyz, t) }; };
  const auto valueAt = [&](double t)
  {
    ++evaluations;
    return evaluateGradient(form, at(t)).value.w - isovalue;
  };
  double below = 0.0, above = 1.0;
  double valueBelow = valueAt(below), valueAbove = valueAt(above);
  const double enough = nearEnough * (valueAbove - valueBelow);
  double t = 0.5;
  for (int n = 0; n < mostSteps; ++n)
  {
    t = below + (above - below) * valueBelow / (valueBelow - valueAbove);
    const double value = valueAt(t);
    if (!(std::abs(value) > enough))
    {
      break;
    }
    // The Illinois rule: an end that stays counts half, so that it does not stay for long.
    (value < 0.0 ? below : above) = t;
    (value < 0.0 ? valueBelow : valueAbove) = value;
    (value < 0.0 ? valueAbove : valueBelow) *= 0.5;
  }
  return { box.middle.element, at(t) };
}

bool findCriticalPoint(
  const ElementMesh& mesh, double isovalue, const SurfaceBox& box, CriticalPoint& result)
{
  constexpr int maximumSteps = 30;
  constexpr double converged = 1e-12;
  constexpr double searchRadii = 4.0;
  const BernsteinForm form = mesh.form(box.middle.element);
  const Range range = fieldRange(form);
  glm::dvec3 u = box.middle.u.xyz;
  for (int step = 0; step < maximumSteps; ++step)
  {
    const Jet jet = evaluateHessian(form, { u });
    const glm::dvec3 gradient(jet.first[0].w, jet.first[1].w, jet.first[2].w);
    const glm::dmat3 hessian = symmetric(jet.second);
    if (glm::determinant(hessian) == 0.0)
    {
      return false;
    }
    const glm::dvec3 du = -glm::inverse(hessian) * gradient;
    u += du;
    if (!(glm::distance(u, box.middle.u.xyz) <= searchRadii * box.referenceRadius))
    {
      return false;
    }
    if (glm::length(du) < converged)
    {
      const double value = evaluateGradient(form, { u }).value.w - isovalue;
      constexpr double rounding = 1e-12;
      result.location = { box.middle.element, { u } };
      result.onSurface = std::abs(value) <=
        rounding * (std::abs(range.lower) + std::abs(range.upper) + std::abs(isovalue));
      return true;
    }
  }
  return false;
}

std::vector<SurfaceBox> findSurfaceBoxes(
  const ElementMesh& mesh, double isovalue, double wantedSize, const ParallelFor& parallelFor)
{
  return findSurfaceBoxes(
    mesh, isovalue, [wantedSize](const SurfaceBox& box) { return box.size <= wantedSize; },
    parallelFor);
}

std::vector<SurfaceBox> findSurfaceBoxes(const ElementMesh& mesh, double isovalue,
  const std::function<bool(const SurfaceBox&)>& isSmall, const ParallelFor& parallelFor,
  const std::function<void(double)>& found)
{
  std::vector<SurfaceBox> boxes;
  const auto reportElements = [&](double done)
  { report(found, done / static_cast<double>(mesh.elements.size())); };
  if (mesh.elements.size() < fewElements)
  {
    ElementSplitter splitter(mesh, isovalue, isSmall);
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    {
      splitter.split(
        e, parallelFor, [&, e](double share) { reportElements(e + share); }, boxes);
      reportElements(e + 1);
    }
    return boxes;
  }
  std::atomic<int> done{ 0 };
  std::vector<std::vector<SurfaceBox>> ofElement(mesh.elements.size());
  runParallel(parallelFor, static_cast<std::ptrdiff_t>(mesh.elements.size()),
    [&](std::ptrdiff_t begin, std::ptrdiff_t end)
    {
      ElementSplitter splitter(mesh, isovalue, isSmall);
      for (std::ptrdiff_t e = begin; e < end; ++e)
      {
        splitter.split(static_cast<int>(e), {}, {}, ofElement[e]);
        reportElements(++done);
      }
    });
  boxes.reserve(std::accumulate(ofElement.begin(), ofElement.end(), std::size_t{ 0 },
    [](std::size_t sum, const auto& some) { return sum + some.size(); }));
  for (const auto& some : ofElement)
  {
    boxes.insert(boxes.end(), some.begin(), some.end());
  }
  return boxes;
}

} // namespace hop
