// JSON as text: that of others parsed so that a damaged one is refused in one line, ours written whatever
// names it has.
#pragma once

#include <algorithm>
#include <istream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "mesher/core/error.hpp"

namespace cbc3d {

/// No file of this project nests deeper than ten. The library compares, copies and prints recursively, so
/// that some ten thousand levels overflow the stack.
inline constexpr int kMostJsonDepth = 100;

/// Depth of the deepest bracket outside strings, whether or not brackets match.
inline int json_depth(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (in_string) {
      at += c == '\\' ? 1 : 0;
      in_string = c != '"';
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    } else {
      in_string = c == '"';
    }
  }
  return deepest;
}

/// The number or word around a byte, counted from 1; at most 40 characters of it.
inline std::string json_word_at(std::string_view text, std::size_t byte) {
  const auto is_part = [&](std::size_t at) {
    return at < text.size() && std::string_view(" \t\r\n,:[]{}\"").find(text[at]) == std::string_view::npos;
  };
  std::size_t begin = byte > 0 ? byte - 1 : 0;
  while (begin > 0 && is_part(begin - 1)) {
    --begin;
  }
  std::size_t end = begin;
  while (is_part(end) && end < begin + 40) {
    ++end;
  }
  return std::string(text.substr(std::min(begin, text.size()), end - begin));
}

/// The text as JSON. Throws InputError, whose line begins with `subject` (the file in quotes), where it is no
/// JSON, nests deeper than kMostJsonDepth or has a number beyond those of double precision.
template <typename Json>
Json parse_json(std::string_view text, const std::string& subject) {
  if (const int depth = json_depth(text); depth > kMostJsonDepth) {
    throw InputError(subject + " nests brackets " + std::to_string(depth) + " deep, more than " +
                     std::to_string(kMostJsonDepth) + "; write it anew");
  }
  try {
    return Json::parse(text);
  } catch (const typename Json::parse_error& error) {
    throw InputError(subject + " is no JSON: " + error.what() + ", in '" + json_word_at(text, error.byte) +
                     "'");
  } catch (const typename Json::out_of_range& error) {
    throw InputError(subject + " has a number beyond those of double precision (" + error.what() +
                     "); correct it");
  }
}

/// The rest of a stream as JSON, likewise.
template <typename Json>
Json parse_json(std::istream& stream, const std::string& subject) {
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return parse_json<Json>(std::string_view(text), subject);
}

/// The object in a stream; an empty one where there is none, for reports that a program may have left
/// damaged.
template <typename Json>
Json json_object_or_empty(std::istream& stream) {
  try {
    Json content = stream ? parse_json<Json>(stream, "") : Json();
    return content.is_object() ? content : Json::object();
  } catch (const InputError&) {
    return Json::object();
  }
}

/// The text of JSON, indented by so many blanks (-1: in one line). Bytes that are no UTF-8, as names of files
/// may have them, are replaced.
template <typename Json>
std::string json_text(const Json& json, int indent = 2) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace cbc3d
