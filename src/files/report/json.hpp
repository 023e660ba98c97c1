// A JSON value for reports. Objects keep the order in which members were added.
//
//     Json report = {{"command", "lint"}, {"size", {640, 480}}};
//     report["angles"].push_back(1.5);
//     const std::string text = toText(report);
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace cotan {

class Json {
public:
    using Array = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;
    using Value = std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object>;

    Json(std::nullptr_t = nullptr) {}
    Json(std::same_as<bool> auto yes) : value_(yes) {}
    Json(std::signed_integral auto number) : value_(std::int64_t(number)) {}
    Json(std::unsigned_integral auto number) requires(!std::same_as<decltype(number), bool>)
        : value_(std::uint64_t(number))
    {
    }
    Json(std::floating_point auto number) : value_(double(number)) {}
    Json(std::string text) : value_(std::move(text)) {}
    Json(std::string_view text) : value_(std::string(text)) {}
    Json(const char* text) : value_(std::string(text)) {}
    template<class T> Json(const std::vector<T>& values) : value_(Array(values.begin(), values.end())) {}
    template<class T, std::size_t n> Json(const std::array<T, n>& values) : value_(Array(values.begin(), values.end()))
    {
    }
    // An object if every item is a pair of a name and a value; otherwise an array.
    Json(std::initializer_list<Json> items);

    static Json array() { return Json(Value(Array())); }
    static Json object() { return Json(Value(Object())); }

    // Returns the named member, which is added as null if missing. The value must be an object or null.
    Json& operator[](std::string_view name);
    // Appends an item to an array; null becomes an array.
    void push_back(Json item);
    // Copies the members of another object, replacing existing values.
    void update(const Json& object);
    void erase(std::string_view name);

    const Value& value() const { return value_; }

private:
    explicit Json(Value value) : value_(std::move(value)) {}

    Value value_ = nullptr;
};

// Serialises indented by two columns, with a final newline. Non-finite numbers become null; bad UTF-8 is replaced.
std::string toText(const Json& json);

// Returns the report with "format" and "version" before its own members: its name, and the version of its fields that
// this program writes. format: a name in the list in json.cpp. docs/reference/json.md lists the fields;
// tests/json_fields_test.py compares it with the output of commands.
Json versioned(std::string_view format, const Json& report);

// Likewise for a command's report, whose format follows from its member "command".
Json versioned(const Json& report);

} // namespace cotan
