#include "Support/ByteHash.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace
{

std::uint64_t hashOfBytes(const std::vector<unsigned char>& bytes)
{
  hop::ByteHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

/// 0, 1, 2 and so on.
std::vector<unsigned char> ascending(std::size_t size)
{
  std::vector<unsigned char> bytes(size);
  std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(0));
  return bytes;
}

} // namespace

TEST(ByteHash, IsTheSameForTheSameBytes)
{
  for (std::size_t size : { 0, 1, 31, 32, 33, 200 })
  {
    EXPECT_EQ(hashOfBytes(ascending(size)), hashOfBytes(ascending(size)));
  }
}

TEST(ByteHash, ChangesWithEveryBit)
{
  for (std::size_t size : { 1, 31, 32, 33, 71 })
  {
    const std::vector<unsigned char> bytes = ascending(size);
    std::set<std::uint64_t> seen = { hashOfBytes(bytes) };
    for (std::size_t bit = 0; bit < 8 * size; ++bit)
    {
      std::vector<unsigned char> other = bytes;
      other[bit / 8] = static_cast<unsigned char>(other[bit / 8] ^ (1U << (bit % 8)));
      seen.insert(hashOfBytes(other));
    }
    EXPECT_EQ(seen.size(), 8 * size + 1);
  }
}

TEST(ByteHash, ChangesWithTheOrderAndWithTheEndsOfItsParts)
{
  std::set<std::uint64_t> seen;
  for (const std::vector<std::string>& parts : std::vector<std::vector<std::string>>{
         { "ab", "c" }, { "a", "bc" }, { "c", "ab" }, { "abc" }, { "abc", "" }, { "", "abc" } })
  {
    hop::ByteHash hash;
    for (const std::string& part : parts)
    {
      hash.add(part);
    }
    seen.insert(hash.value());
  }
  EXPECT_EQ(seen.size(), 6U);
}

TEST(ByteHash, TellsZerosOfDifferentLengthApart)
{
  std::set<std::uint64_t> seen;
  for (std::size_t size = 0; size < 100; ++size)
  {
    seen.insert(hashOfBytes(std::vector<unsigned char>(size)));
  }
  EXPECT_EQ(seen.size(), 100U);
}
