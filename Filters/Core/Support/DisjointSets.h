#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace hop
{

/// Numbers from 0 in sets that may be united; each set goes by the least of its numbers.
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }

  /// The least number of the set that n is in.
  int root(int n)
  {
    while (this->Parent[n] != n)
    {
      n = this->Parent[n] = this->Parent[this->Parent[n]];
    }
    return n;
  }

  void unite(int a, int b)
  {
    const auto [less, more] = std::minmax({ this->root(a), this->root(b) });
    this->Parent[more] = less;
  }

private:
  std::vector<int> Parent;
};

} // namespace hop
