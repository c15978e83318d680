#include "Input/UserMessage.h"

#include <algorithm>

namespace hop
{

std::string listOf(const std::vector<std::string>& names)
{
  constexpr std::size_t most = 10; // names; more would hide the rest of the message
  std::string list;
  for (std::size_t n = 0; n < std::min(names.size(), most); ++n)
  {
    list += (n == 0 ? "" : ", ") + names[n];
  }
  const std::size_t more = names.size() - std::min(names.size(), most);
  return names.empty() ? "none" : list + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

} // namespace hop
