#pragma once

#include <string>
#include <vector>

namespace hop
{

/// What a user is to be told. The filter tells it: observers of errors and warnings listen there.
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

/// In the order in which they are to be told.
using UserMessages = std::vector<UserMessage>;

/// "a, b, c and 2 more", or "none".
std::string listOf(const std::vector<std::string>& names);

} // namespace hop
