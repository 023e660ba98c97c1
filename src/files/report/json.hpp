// A JSON value for reports: objects keep the order in which their members were added.
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
    // An object where every item is a pair of a name and a value; otherwise an array.
    Json(std::initializer_list<Json> items);

    static Json array() { return Json(Value(Array())); }
    static Json object() { return Json(Value(Object())); }

    // The member of that name, null at first. Nothing but null and objects has members.
    Json& operator[](std::string_view name);
    // Adds an item to an array; null becomes one.
    void push_back(Json item);
    // Takes over the members of another object; those that are there already get its values.
    void update(const Json& object);
    void erase(std::string_view name);

    const Value& value() const { return value_; }

private:
    explicit Json(Value value) : value_(std::move(value)) {}

    Value value_ = nullptr;
};

// Indented by two columns, with a newline at the end. Numbers that are not finite are null; bytes that are no UTF-8 are
// replaced.
std::string toText(const Json& json);

// The report with "format" and "version" before its own members: what it is called, and which version of its fields
// this program writes. format: a name of the list in json.cpp. docs/reference/json.md lists the fields;
// tests/json_fields_test.py holds it against what commands write.
Json versioned(std::string_view format, const Json& report);

// The same for a command's, by its own member "command".
Json versioned(const Json& report);

} // namespace cotan
