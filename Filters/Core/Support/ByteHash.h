#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace hop
{

/// One number for any amount of data, to tell whether they are the same as before. Different data have the same number
/// by chance in one of 2^64 cases; it is no protection against data that are made for it.
class ByteHash
{
public:
  /// Adds the size, and the bytes. Four sums that do not wait for each other read as fast as memory delivers.
  void add(const void* bytes, std::size_t size)
  {
    this->addWord(size);
    const auto* at = static_cast<const unsigned char*>(bytes);
    constexpr std::size_t block = sizeof(Words);
    for (; size >= block; size -= block, at += block)
    {
      Words words;
      std::memcpy(words.data(), at, block);
      for (std::size_t i = 0; i < words.size(); ++i)
      {
        this->Sums[i] = mixed(this->Sums[i], words[i]);
      }
    }
    Words rest{};
    if (size > 0)
    {
      std::memcpy(rest.data(), at, size);
    }
    for (std::size_t i = 0; i < rest.size(); ++i)
    {
      this->Sums[i] = mixed(this->Sums[i], rest[i]);
    }
  }

  void add(const std::string& text) { this->add(text.data(), text.size()); }
  void add(double number) { this->add(&number, sizeof(number)); }
  void addWord(std::uint64_t word) { this->Sums[0] = mixed(this->Sums[0], word); }

  std::uint64_t value() const
  {
    std::uint64_t all = 0;
    for (const std::uint64_t sum : this->Sums)
    {
      all = mixed(all, sum);
    }
    return all;
  }

private:
  using Words = std::array<std::uint64_t, 4>;

  /// As in hashOf() of Support/VectorHash.h. One step is a bijection of either argument: data that differ in one word
  /// have different sums.
  static std::uint64_t mixed(std::uint64_t sum, std::uint64_t word)
  {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15ULL;
    return sum ^ (sum >> 32);
  }

  Words Sums = { 1, 2, 3, 4 };
};

} // namespace hop
