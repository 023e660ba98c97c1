#include "files/report/json.hpp"

#include <algorithm>
#include <cassert>

#include <nlohmann/json.hpp>

namespace cotan {

namespace {

// Returns the item's [name, value] pair if it can be a member of an object; otherwise null.
const Json::Array* asMember(const Json& item)
{
    const auto* pair = std::get_if<Json::Array>(&item.value());
    return pair && pair->size() == 2 && std::holds_alternative<std::string>((*pair)[0].value()) ? pair : nullptr;
}

nlohmann::ordered_json converted(const Json& json)
{
    return std::visit(
        []<class T>(const T& value) -> nlohmann::ordered_json {
            if constexpr (std::same_as<T, Json::Array>) {
                auto array = nlohmann::ordered_json::array();
                for (const Json& item : value)
                    array.push_back(converted(item));
                return array;
            } else if constexpr (std::same_as<T, Json::Object>) {
                auto object = nlohmann::ordered_json::object();
                for (const auto& [name, member] : value)
                    object[name] = converted(member);
                return object;
            } else {
                return value;
            }
        },
        json.value());
}

// Version of all formats so far. Adding a field keeps the version. Removing or renaming a field, or changing its type
// or meaning, raises that report's version alone: the first such report gets its own number beside its name.
constexpr int kVersion = 1;

} // namespace

Json::Json(std::initializer_list<Json> items)
{
    if (!std::ranges::all_of(items, asMember)) {
        value_ = Array(items);
        return;
    }
    value_ = Object();
    for (const Json& item : items) {
        const Array& pair = *asMember(item);
        (*this)[std::get<std::string>(pair[0].value())] = pair[1];
    }
}

Json& Json::operator[](std::string_view name)
{
    if (std::holds_alternative<std::nullptr_t>(value_))
        value_ = Object();
    auto& members = std::get<Object>(value_);
    const auto found = std::ranges::find(members, name, &Object::value_type::first);
    return found != members.end() ? found->second : members.emplace_back(name, Json()).second;
}

void Json::push_back(Json item)
{
    if (std::holds_alternative<std::nullptr_t>(value_))
        value_ = Array();
    std::get<Array>(value_).push_back(std::move(item));
}

void Json::update(const Json& object)
{
    for (const auto& [name, member] : std::get<Object>(object.value_))
        (*this)[name] = member;
}

void Json::erase(std::string_view name)
{
    std::erase_if(std::get<Object>(value_), [&](const auto& member) { return member.first == name; });
}

std::string toText(const Json& json)
{
    return converted(json).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Json versioned(std::string_view format, const Json& report)
{
    Json all = {{"format", format}, {"version", kVersion}};
    all.update(report);
    return all;
}

Json versioned(const Json& report)
{
    const auto& members = std::get<Json::Object>(report.value());
    const auto command = std::ranges::find(members, "command", &Json::Object::value_type::first);
    assert(command != members.end());
    std::string format = "cotan-" + std::get<std::string>(command->second.value()); // "cotan-map-detect"
    std::ranges::replace(format, ' ', '-');
    return versioned(format, report);
}

} // namespace cotan
