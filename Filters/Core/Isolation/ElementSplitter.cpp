#include "Isolation/ElementSplitter.h"

namespace hop
{
namespace
{

/// Levels of so many pieces keep threads busy, whichever of them take long.
constexpr std::size_t manyPieces = 256;
/// Pieces that are undecided after so many halvings may hold two sheets close to each other.
constexpr int pairBisections = 9;

constexpr Domain anyDomain = Domain::Hexahedron;
constexpr Degrees anyDegrees{ 1, 1, 1 };

} // namespace

ElementSplitter::ElementSplitter(
  const ElementMesh& mesh, double isovalue, const std::function<bool(const SurfaceBox&)>& isSmall)
  : Mesh(mesh)
  , Isovalue(isovalue)
  , IsSmall(isSmall)
  , Kind(anyDomain, anyDegrees)
  , Tests(anyDomain, anyDegrees, isovalue)
{
}

void ElementSplitter::split(int element, const ParallelFor& parallelFor, const ReportShare& found,
  std::vector<SurfaceBox>& boxes)
{
  this->prepareFor(this->Mesh.form(element));
  const auto whole = [&] { return wholeElement(this->Mesh, element, this->Isovalue, this->Kind); };
  // Level by level, so that the limit on pieces cuts all of the element at the same size.
  std::vector<Piece> level;
  level.push_back(whole());
  if (!level.front().isFinite())
  {
    return;
  }
  this->Tests.beginElement(level.front());
  FoundShare share(found);
  const std::size_t before = boxes.size();
  LeftUndecided left;
  while (!level.empty())
  {
    const GivenUp some = givenUp(level, boxes.size() > before, this->Tests);
    share.beginLevel(level.size());
    std::vector<Outcome> outcomes = this->decideAll(level, some, parallelFor, share);
    level = sortOut(std::move(level), std::move(outcomes), boxes, left);
  }
  if (!left.boxes.empty())
  {
    appendLeft(left, whole(), this->Tests, boxes);
  }
}

void ElementSplitter::prepareFor(const BernsteinForm& form)
{
  if (form.domain != this->Kind.domain || form.degrees != this->Kind.degrees)
  {
    this->Kind = PieceKind(form.domain, form.degrees);
    this->Tests = PieceTests(form.domain, form.degrees, this->Isovalue);
  }
}

std::vector<ElementSplitter::Outcome> ElementSplitter::decideAll(std::vector<Piece>& level,
  const GivenUp& givenUp, const ParallelFor& parallelFor, FoundShare& share) const
{
  // Pieces of high degree are large: once there are enough for all threads, certified ones are
  // followed to their boxes one by one.
  const bool toTheEnd = level.size() >= manyPieces;
  std::vector<Outcome> outcomes(level.size());
  forAll(parallelFor, level.size(),
    [&](std::size_t n)
    {
      outcomes[n] = this->decide(level[n], givenUp, toTheEnd);
      if (!outcomes[n].isHalved)
      {
        share.closePiece(outcomes[n].boxes.empty());
      }
    });
  return outcomes;
}

/// \return the next level
std::vector<Piece> ElementSplitter::sortOut(std::vector<Piece> level, std::vector<Outcome> outcomes,
  std::vector<SurfaceBox>& boxes, LeftUndecided& left)
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

ElementSplitter::Outcome ElementSplitter::decide(
  Piece& piece, const GivenUp& givenUp, bool toTheEnd) const
{
  Outcome outcome;
  if (!this->Tests.mayHoldSurface(piece))
  {
    return outcome;
  }
  piece.sheet = piece.certified() ? piece.sheet : this->Tests.sheetIn(piece);
  if (piece.certified() && toTheEnd)
  {
    this->followToBoxes(piece, outcome.boxes);
    return outcome;
  }
  if (!(piece.certified() ? this->finishCertified(piece, outcome.boxes)
                          : this->finishUndecided(piece, givenUp, outcome)))
  {
    outcome.isHalved = true;
    outcome.second = halve(piece);
  }
  return outcome;
}

/// \return whether there is nothing to halve
bool ElementSplitter::finishCertified(const Piece& piece, std::vector<SurfaceBox>& boxes) const
{
  const SurfaceBox box = boxOf(piece, this->Tests);
  const bool isFinished = piece.bisections == MaximumBisections || this->IsSmall(box);
  if (isFinished)
  {
    boxes.push_back(box);
  }
  return isFinished;
}

/// \return whether there is nothing to halve
bool ElementSplitter::finishUndecided(
  const Piece& piece, const GivenUp& givenUp, Outcome& outcome) const
{
  const bool isDeep = piece.bisections == MaximumBisections;
  const bool isLast = isDeep || givenUp.all;
  const bool mayBeTangent = isGivenUp(piece, givenUp, this->Tests);
  const auto pair = this->sheetPairIn(piece, isLast || mayBeTangent);
  if (pair)
  {
    if (isLast || pair->isFlat())
    {
      appendSheetPair(piece, *pair, outcome.boxes);
      return true;
    }
    return false;
  }
  if (!isLast && !mayBeTangent)
  {
    return false;
  }
  SurfaceBox box = boxOf(piece, this->Tests);
  box.certified = !mayBeTangent && this->Tests.rises(piece);
  outcome.isLeft = mayBeTangent || (!box.certified && !box.straddles && !isDeep);
  outcome.boxes.push_back(box);
  return true;
}

/// Two sheets close to each other in a piece that is small or will not be halved.
std::optional<SheetPair> ElementSplitter::sheetPairIn(const Piece& piece, bool isLast) const
{
  const bool isReady =
    isLast || (piece.bisections >= pairBisections && this->IsSmall(boxOf(piece, this->Tests)));
  return isReady ? this->Tests.sheetPairIn(piece) : std::nullopt;
}

/// Splits a certified piece until its parts are small enough.
void ElementSplitter::followToBoxes(Piece& piece, std::vector<SurfaceBox>& boxes) const
{
  if (!this->Tests.mayHoldSurface(piece))
  {
    return;
  }
  if (!this->finishCertified(piece, boxes))
  {
    Piece second = halve(piece);
    this->followToBoxes(second, boxes);
    this->followToBoxes(piece, boxes);
  }
}

} // namespace hop
