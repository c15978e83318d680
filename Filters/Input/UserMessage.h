#pragma once

#include <string>
#include <vector>

namespace hop
{

/// A text for the user. The filter itself passes it on: observers of errors and warnings listen to the filter.
struct UserMessage
{
  enum Kind
  {
    Warning,
    Error
  };
  Kind kind = Warning;
  std::string text;
};

/// In the order in which the user is told.
using UserMessages = std::vector<UserMessage>;

/// "a, b, c and 2 more", or "none".
std::string listOf(const std::vector<std::string>& names);

} // namespace hop
