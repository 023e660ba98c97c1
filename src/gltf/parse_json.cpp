#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "gltf_file.hpp"

namespace cotan {

using gltf::Json;

namespace {

// Builds the document from the events of the parser. The library's own builder looks for each new member among all
// that its object has already, so that an object of a million members would take hours.
class Builder : public nlohmann::json_sax<Json> {
public:
    explicit Builder(std::string_view text) : text_(text) {}

    Json root;

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; } // not in JSON
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override
    {
        member_ = &levels_.back().place(name);
        return true;
    }

    // position: of the last byte that was read, from 1. The parser's own sentences are for programmers.
    bool parse_error(std::size_t position, const std::string& last, const nlohmann::detail::exception& problem) override
    {
        const std::string_view before = text_.substr(0, std::min(std::max<std::size_t>(position, 1) - 1, text_.size()));
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t column = before.size() - (before.find_last_of('\n') + 1) + 1; // npos + 1 is 0
        constexpr int kNumberTooLarge = 406;
        const bool ended = position > text_.size();
        failGltf("JSON: line {}, column {}: expected {}; found {}", line, column,
                 problem.id == kNumberTooLarge ? "a number that a double holds"
                     : ended                   ? "more"
                                               : "valid JSON",
                 ended ? "the end of the file" : quotedTail(last));
    }

private:
    struct Level {
        Json* value = nullptr;
        std::map<std::string, std::size_t> places{}; // of the members of an object, once there are many

        // The member of that name; a new one where there is none.
        Json& place(string_t& name)
        {
            constexpr std::size_t kFew = 16;
            auto& members = value->get_ref<Json::object_t&>();
            if (members.size() < kFew) {
                for (auto& [known, member] : members)
                    if (known == name)
                        return member;
            } else {
                if (places.empty())
                    for (const auto& [known, member] : members)
                        places.emplace(known, places.size());
                if (const auto [known, isNew] = places.emplace(name, members.size()); !isNew)
                    return (members.begin() + std::ptrdiff_t(known->second))->second;
            }
            members.emplace_back(std::move(name), nullptr);
            return members.back().second;
        }
    };

    // The end of what was read, on one line.
    static std::string quotedTail(std::string_view read)
    {
        constexpr std::size_t kMax = 24;
        std::string tail(read.substr(read.size() - std::min(read.size(), kMax)));
        for (char& c : tail)
            if (c < ' ' || c > '~')
                c = '?';
        return "'" + tail + "'";
    }

    // Where the next value goes: the root, a member, or the end of an array.
    Json& put(Json&& value)
    {
        if (levels_.empty())
            return root = std::move(value);
        Json& owner = *levels_.back().value;
        if (owner.is_object())
            return *member_ = std::move(value);
        auto& items = owner.get_ref<Json::array_t&>();
        items.push_back(std::move(value));
        return items.back();
    }

    template<class T> bool put(T&& value)
    {
        put(Json(std::forward<T>(value)));
        return true;
    }

    bool open(Json&& value)
    {
        constexpr std::size_t kDeepest = 128; // what walks through a document recurses once a level
        if (levels_.size() >= kDeepest)
            failGltf("JSON: nested deeper than {} levels", kDeepest);
        levels_.push_back({&put(std::move(value))});
        return true;
    }

    bool close()
    {
        levels_.pop_back();
        return true;
    }

    std::string_view text_;
    std::vector<Level> levels_; // the objects and arrays that are open
    Json* member_ = nullptr;    // of the innermost, named last
};

} // namespace

gltf::Json parseGltfJson(std::span<const std::byte> text)
{
    const auto* const first = reinterpret_cast<const char*>(text.data());
    Builder builder({first, text.size()});
    Json::sax_parse(first, first + text.size(), &builder);
    return std::move(builder.root);
}

} // namespace cotan
