#include "Isolation/ElementSplitter.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace hop
{
namespace
{

/// Pieces in a level from which each certified piece is followed to its boxes by one thread, instead of level by level.
/// Chosen by experiment: one element of order 8 with 786,000 particles takes 1.1 GB and 7 s, and 7.2 GB and 12 s
/// level by level. Fewer leave threads idle where some pieces take long; more take more memory, as pieces of high
/// degree are large.
constexpr std::size_t manyPieces = 256;
/// Pieces of a certified one that a thread looks at before it gives back what is left, so that the caller is asked
/// whether to go on: some 0.05 s at degree 9. Only in elements that are folded over and over there are more. Fewer make
/// levels of their own, each with a start of the threads; more make the caller wait.
constexpr int mostFollowed = 2048;
/// Bisections after which an undecided piece is tested for two sheets close to each other: three along each axis of a
/// nearly cubic element, chosen by experiment. After fewer bisections the sheets are rarely flat enough; more only
/// halve pieces in vain.
constexpr int pairBisections = 9;
/// Size of an undecided piece, of its element's, below which it is not halved any more: a quarter of what
/// MaximumBisections leave of a nearly cubic element. Larger: components are lost that these would find; smaller: where
/// surfaces meet in an apex, pieces are halved down to 1e-10 of a pyramid, most of which has none of them.
constexpr double smallestPiece = 0x1p-14;
/// Pieces of all levels that one thread decides in an element before all threads take it over, from its beginning. Fewer:
/// more elements are begun twice; more: the caller, who is asked between elements, waits. Chosen by Testing/Fuzz: seed
/// 151 of grid_fuzz asks after 0.2 s of four threads, which is the period of all of them, instead of 0.5 s of one.
constexpr std::size_t mostAlone = 4096;
/// The same in coefficients of these pieces, where an element has more than 512: of degree 9 some 0.05 s.
constexpr std::size_t mostCoefficientsAlone = std::size_t{ 1 } << 21;
/// The same as mostFollowed where one thread decides an element: a level of manyPieces is no more than four times
/// mostAlone.
constexpr int mostFollowedAlone = 64;

} // namespace

PreparedKinds::PreparedKinds(const ElementMesh& mesh, double isovalue)
{
  for (const Element& element : mesh.elements)
  {
    const auto key = std::make_pair(element.domain, element.degrees);
    if (this->Kinds.count(key) == 0)
    {
      this->Kinds.emplace(key,
        Prepared{
          { element.domain, element.degrees }, { element.domain, element.degrees, isovalue } });
    }
  }
}

ElementSplitter::ElementSplitter(const ElementMesh& mesh, double isovalue,
  const PreparedKinds& kinds, const std::function<bool(const SurfaceBox&)>& isSmall)
  : Mesh(mesh)
  , Isovalue(isovalue)
  , Kinds(kinds)
  , IsSmall(isSmall)
{
}

void ElementSplitter::split(int element, const ParallelFor& parallelFor,
  const ReportProgress& progress, std::vector<SurfaceBox>& boxes)
{
  this->splitWithin(std::numeric_limits<std::size_t>::max(), element, parallelFor, progress, boxes);
}

bool ElementSplitter::splitIfShort(int element, std::vector<SurfaceBox>& boxes)
{
  const Element& whole = this->Mesh.elements[element];
  const std::size_t coefficients = coefficientCount(whole.domain, whole.degrees);
  return this->splitWithin(
    std::min(mostAlone, mostCoefficientsAlone / coefficients), element, {}, {}, boxes);
}

/// \return whether all pieces, of all levels together, are no more than so many; else nothing is appended
bool ElementSplitter::splitWithin(std::size_t mostPieces, int element,
  const ParallelFor& parallelFor, const ReportProgress& progress, std::vector<SurfaceBox>& boxes)
{
  this->prepareFor(this->Mesh.elements[element]);
  const auto whole = [&] { return wholeElement(this->Mesh, element, this->Isovalue, *this->Kind); };
  // Level by level, so that the limit on undecided pieces stops all of them at one size.
  std::vector<Piece> level;
  level.push_back(whole());
  if (!level.front().isFinite())
  {
    return true;
  }
  this->Tests.beginElement(level.front());
  this->ElementSize = level.front().worldSize();
  IsolationProgress ofElement(progress);
  const std::size_t before = boxes.size();
  UndecidedPieces undecided;
  for (std::size_t pieces = 1; !level.empty(); pieces += level.size())
  {
    if (pieces > mostPieces)
    {
      boxes.resize(before);
      return false;
    }
    const StopRule rule = stopRuleOf(
      level, boxes.size() > before, this->Tests, this->Mesh.elements[element].partsOfCell);
    ofElement.beginLevel(level.size());
    const int mostOfPiece = mostPieces > mostAlone ? mostFollowed : mostFollowedAlone;
    std::vector<Outcome> outcomes = this->decideAll(
      level, rule, level.size() < manyPieces ? 0 : mostOfPiece, parallelFor, ofElement);
    level = sortOut(std::move(level), std::move(outcomes), boxes, undecided);
  }
  if (!undecided.boxes.empty())
  {
    appendUndecided(undecided, whole(), this->Tests, boxes);
  }
  return true;
}

void ElementSplitter::prepareFor(const Element& element)
{
  if (!this->Kind || element.domain != this->Kind->domain || element.degrees != this->Kind->degrees)
  {
    const PreparedKinds::Prepared& prepared = this->Kinds.of(element.domain, element.degrees);
    this->Kind = &prepared.kind;
    this->Tests = prepared.tests;
  }
}

std::vector<ElementSplitter::Outcome> ElementSplitter::decideAll(std::vector<Piece>& level,
  const StopRule& rule, int follow, const ParallelFor& parallelFor,
  IsolationProgress& progress) const
{
  std::vector<Outcome> outcomes(level.size());
  forAll(parallelFor, level.size(),
    [&](std::size_t n)
    {
      outcomes[n] = this->decide(level[n], rule, follow);
      if (outcomes[n].next.empty())
      {
        progress.closePiece(outcomes[n].boxes.empty());
      }
    });
  return outcomes;
}

/// Collects the boxes of a level.
/// \return the next level
std::vector<Piece> ElementSplitter::sortOut(std::vector<Piece> level, std::vector<Outcome> outcomes,
  std::vector<SurfaceBox>& boxes, UndecidedPieces& undecided)
{
  std::vector<Piece> next;
  for (std::size_t n = 0; n < level.size(); ++n)
  {
    Outcome& outcome = outcomes[n];
    std::vector<SurfaceBox>& list = outcome.isUndecided ? undecided.boxes : boxes;
    list.insert(list.end(), outcome.boxes.begin(), outcome.boxes.end());
    if (outcome.isUndecided)
    {
      undecided.parts.insert(level[n].part);
    }
    std::move(outcome.next.begin(), outcome.next.end(), std::back_inserter(next));
  }
  return next;
}

ElementSplitter::Outcome ElementSplitter::decide(
  Piece& piece, const StopRule& rule, int follow) const
{
  Outcome outcome;
  if (!this->Tests.mayHoldSurface(piece))
  {
    return outcome;
  }
  piece.sheet = piece.certified() ? piece.sheet : this->Tests.sheetIn(piece);
  if (piece.certified() && follow > 0)
  {
    outcome.next = this->followToBoxes(std::move(piece), follow, outcome.boxes);
    return outcome;
  }
  if (!(piece.certified() ? this->finishCertified(piece, outcome.boxes)
                          : this->finishUndecided(piece, rule, outcome)))
  {
    outcome.next.push_back(halve(piece));
    outcome.next.push_back(std::move(piece));
  }
  return outcome;
}

/// Appends the box of a certified piece if it is small enough.
/// \return whether the piece is not to be halved
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

/// Appends the box of an undecided piece, or the boxes of its two sheets, if halving it further would be no use.
/// \return whether the piece is not to be halved
bool ElementSplitter::finishUndecided(
  const Piece& piece, const StopRule& rule, Outcome& outcome) const
{
  std::optional<SurfaceBox> box;
  if (piece.bisections >= pairBisections)
  {
    box = boxOf(piece, this->Tests);
  }
  const bool isDeep =
    piece.bisections == MaximumBisections || (box && box->size < smallestPiece * this->ElementSize);
  const bool isLast = isDeep || rule.all;
  const bool mayBeTangent = staysUndecided(piece, rule, this->Tests);
  if (isLast || mayBeTangent || (box && this->IsSmall(*box)))
  {
    const std::optional<SheetPair> pair = this->Tests.sheetPairIn(piece);
    if (pair && (isLast || pair->isFlat()))
    {
      appendBoxesOfPair(piece, *pair, outcome.boxes);
      return true;
    }
    if (pair)
    {
      return false;
    }
  }
  if (!isLast && !mayBeTangent)
  {
    return false;
  }
  if (!box)
  {
    box = boxOf(piece, this->Tests);
  }
  box->certified = !mayBeTangent && this->Tests.rises(piece);
  outcome.isUndecided = mayBeTangent || (!box->certified && !box->straddles && !isDeep);
  outcome.boxes.push_back(*box);
  return true;
}

/// Splits a certified piece until all of it has boxes that are small enough, or until most pieces are looked at.
/// \return what is left to be split
std::vector<Piece> ElementSplitter::followToBoxes(
  Piece piece, int most, std::vector<SurfaceBox>& boxes) const
{
  std::vector<Piece> left;
  left.push_back(std::move(piece));
  for (int followed = 0; !left.empty() && followed < most; ++followed)
  {
    Piece last = std::move(left.back());
    left.pop_back();
    if (this->Tests.mayHoldSurface(last) && !this->finishCertified(last, boxes))
    {
      Piece second = halve(last);
      left.push_back(std::move(last));
      left.push_back(std::move(second));
    }
  }
  return left;
}

} // namespace hop
