#include "Output/ForeignCorners.h"

#include "Support/Interruptible.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <map>
#include <string>

namespace hop
{

namespace
{

/// Writes values into bytes one after the other, and reads them again.
class Letter
{
public:
  Letter() = default;
  explicit Letter(Bytes bytes)
    : Content(std::move(bytes))
  {
  }

  template <class T>
  void write(const T* values, std::size_t count)
  {
    const auto* begin = reinterpret_cast<const unsigned char*>(values);
    this->Content.insert(this->Content.end(), begin, begin + count * sizeof(T));
  }
  void write(std::int64_t value) { this->write(&value, 1); }

  template <class T>
  void read(T* values, std::size_t count)
  {
    std::memcpy(values, this->Content.data() + this->Next, count * sizeof(T));
    this->Next += count * sizeof(T);
  }
  std::int64_t read()
  {
    std::int64_t value = 0;
    this->read(&value, 1);
    return value;
  }
  bool isAtEnd() const { return this->Next == this->Content.size(); }
  const Bytes& bytes() const { return this->Content; }

private:
  Bytes Content;
  std::size_t Next = 0;
};

/// A place at which another rank asks for values.
struct Place
{
  std::int64_t element = 0;
  double u[3] = {};
};

/// One question: the places of one block's corners that one rank owns, and the arrays wanted there. The answer has, array
/// by array, whether there is such an array, and then its values.
void ask(const ForeignCorners& mine, const std::vector<std::size_t>& corners, Letter& letter)
{
  letter.write(static_cast<std::int64_t>(mine.arrays.size()));
  for (const EvaluatedArray& array : mine.arrays)
  {
    const std::string name = array.source->GetName();
    letter.write(static_cast<std::int64_t>(name.size()));
    letter.write(name.data(), name.size());
    letter.write(static_cast<std::int64_t>(array.source->GetNumberOfComponents()));
  }
  letter.write(static_cast<std::int64_t>(corners.size()));
  for (const std::size_t c : corners)
  {
    const ForeignCorners::Corner& corner = mine.corners[c];
    const Place place{ corner.home.element, { corner.u.xyz.x, corner.u.xyz.y, corner.u.xyz.z } };
    letter.write(&place, 1);
  }
}

/// Answers the questions of one rank.
class Answerer
{
public:
  Answerer(const InputBlocks& blocks, const GridElements& elements, const ParallelFor& parallelFor)
    : Blocks(blocks)
    , Elements(elements)
    , Parallel(parallelFor)
  {
  }

  /// \return nothing where memory does not hold the answer, or the caller asks for an early end
  Bytes answer(Bytes question) const
  {
    try
    {
      Letter asked(std::move(question));
      Letter answer;
      while (!asked.isAtEnd())
      {
        this->answerOne(asked, answer);
      }
      return answer.bytes();
    }
    catch (const std::exception&)
    {
      return {};
    }
    catch (const Interrupted&)
    {
      return {};
    }
  }

private:
  struct Wanted
  {
    std::string name;
    std::int64_t components = 1;
  };

  void answerOne(Letter& asked, Letter& answer) const
  {
    std::vector<Wanted> arrays(asked.read());
    for (Wanted& array : arrays)
    {
      array.name.resize(asked.read());
      asked.read(array.name.data(), array.name.size());
      array.components = asked.read();
    }
    std::vector<Place> places(asked.read());
    asked.read(places.data(), places.size());
    for (const Wanted& array : arrays)
    {
      std::vector<double> values(places.size() * array.components);
      std::vector<char> isThere(places.size(), 0);
      this->evaluate(array, places, values, isThere);
      answer.write(isThere.data(), isThere.size());
      answer.write(values.data(), values.size());
    }
  }

  /// Evaluates an array at the places in blocks that have it.
  void evaluate(const Wanted& array, const std::vector<Place>& places, std::vector<double>& values,
    std::vector<char>& isThere) const
  {
    std::map<std::size_t, std::vector<std::size_t>> ofBlocks;
    for (std::size_t p = 0; p < places.size(); ++p)
    {
      const Element& element = this->Elements.mesh.elements[places[p].element];
      ofBlocks[this->Blocks.locate(element.cell).block].push_back(p);
    }
    for (const auto& [block, indices] : ofBlocks)
    {
      vtkDataArray* source = this->Blocks[block].grid->GetPointData()->GetArray(array.name.c_str());
      if (!source || source->GetNumberOfComponents() != array.components)
      {
        continue;
      }
      std::vector<Particle> particles(indices.size());
      std::vector<ParticleRow> rows(indices.size());
      for (std::size_t i = 0; i < indices.size(); ++i)
      {
        const Place& place = places[indices[i]];
        particles[i].location = { static_cast<int>(place.element),
          ReferencePoint{ glm::dvec3(place.u[0], place.u[1], place.u[2]) } };
        rows[i].particle = &particles[i];
      }
      std::vector<double> found(indices.size() * array.components);
      evaluatePointArrays(
        this->Blocks, block, this->Elements, { { source, found.data() } }, rows, this->Parallel);
      for (std::size_t i = 0; i < indices.size(); ++i)
      {
        isThere[indices[i]] = 1;
        std::copy_n(
          &found[i * array.components], array.components, &values[indices[i] * array.components]);
      }
    }
  }

  const InputBlocks& Blocks;
  const GridElements& Elements;
  const ParallelFor& Parallel;
};

/// Puts an answer where it belongs.
void take(const ForeignCorners& mine, const std::vector<std::size_t>& corners, Letter& answer)
{
  for (const EvaluatedArray& array : mine.arrays)
  {
    const int components = array.source->GetNumberOfComponents();
    std::vector<char> isThere(corners.size());
    std::vector<double> values(corners.size() * components);
    answer.read(isThere.data(), isThere.size());
    answer.read(values.data(), values.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      if (isThere[i])
      {
        std::copy_n(&values[i * components], components,
          array.target + mine.corners[corners[i]].row * components);
      }
    }
  }
}

void sendBytes(Exchange& exchange, const Bytes& bytes, int to)
{
  const auto size = static_cast<std::int64_t>(bytes.size());
  sendArray(exchange, &size, 1, to);
  sendArray(exchange, bytes.data(), bytes.size(), to);
}

Bytes receiveBytes(Exchange& exchange, int from)
{
  std::int64_t size = 0;
  receiveArray(exchange, &size, 1, from);
  Bytes bytes(size);
  receiveArray(exchange, bytes.data(), bytes.size(), from);
  return bytes;
}

/// A rank, and for each of this rank's blocks the corners that are at home there.
using CornersOfRanks = std::map<int, std::vector<std::vector<std::size_t>>>;

CornersOfRanks sortByRank(const std::vector<ForeignCorners>& mine)
{
  CornersOfRanks result;
  for (std::size_t b = 0; b < mine.size(); ++b)
  {
    for (std::size_t c = 0; c < mine[b].corners.size(); ++c)
    {
      auto& ofBlocks = result[mine[b].corners[c].home.rank];
      ofBlocks.resize(mine.size());
      ofBlocks[b].push_back(c);
    }
  }
  return result;
}

/// Which ranks ask which others, as all ranks see it: pairs of the one that asks and the one that answers, sorted.
std::vector<std::array<int, 2>> pairsOf(Exchange& exchange, const CornersOfRanks& asked)
{
  Letter letter;
  for (const auto& [rank, corners] : asked)
  {
    letter.write(&rank, 1);
  }
  std::vector<std::array<int, 2>> pairs;
  int asking = 0;
  for (const Bytes& bytes : exchange.allGather(letter.bytes()))
  {
    for (Letter ranks(bytes); !ranks.isAtEnd();)
    {
      int answering = 0;
      ranks.read(&answering, 1);
      pairs.push_back({ asking, answering });
    }
    ++asking;
  }
  return pairs;
}

} // namespace

void askForForeignCorners(Exchange& exchange, const InputBlocks& blocks,
  const GridElements& elements, const std::vector<ForeignCorners>& mine, bool isDone,
  const ParallelFor& parallelFor)
{
  if (exchange.isAlone() || !allAgree(exchange, isDone))
  {
    return;
  }
  const CornersOfRanks asked = sortByRank(mine);
  const Answerer answerer(blocks, elements, parallelFor);
  // All ranks go through the pairs in the same order, so that none waits for one that waits.
  for (const auto& [asking, answering] : pairsOf(exchange, asked))
  {
    if (exchange.rank() == asking)
    {
      const auto& ofBlocks = asked.at(answering);
      Letter question;
      for (std::size_t b = 0; b < mine.size(); ++b)
      {
        if (!ofBlocks[b].empty())
        {
          ask(mine[b], ofBlocks[b], question);
        }
      }
      sendBytes(exchange, question.bytes(), answering);
      Letter answer(receiveBytes(exchange, answering));
      for (std::size_t b = 0; b < mine.size() && !answer.isAtEnd(); ++b)
      {
        if (!ofBlocks[b].empty())
        {
          take(mine[b], ofBlocks[b], answer);
        }
      }
    }
    else if (exchange.rank() == answering)
    {
      sendBytes(exchange, answerer.answer(receiveBytes(exchange, asking)), asking);
    }
  }
}

} // namespace hop
