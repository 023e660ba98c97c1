#include "report/measurements.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/parse_number.hpp"
#include "files/bytes.hpp"

namespace cotan {

namespace {

constexpr std::string_view kHeader =
    "table,scene,setting,frame,truth,arithmetic,samples,mean,percentile95,maximum,invalid";
constexpr std::size_t kFields = 11;

std::string quoted(const std::string& field)
{
    if (field.find_first_of(",\"\n") == std::string::npos)
        return field;
    std::string s = "\"";
    for (char c : field)
        s += c == '"' ? std::string("\"\"") : std::string(1, c);
    return s + '"';
}

// Parses the fields of the line at `position` and moves `position` to the next line.
std::vector<std::string> readLine(std::string_view text, std::size_t& position)
{
    std::vector<std::string> fields(1);
    bool inQuotes = false;
    for (; position < text.size(); ++position) {
        const char c = text[position];
        if (c == '"' && inQuotes && position + 1 < text.size() && text[position + 1] == '"') {
            fields.back() += c;
            ++position;
        } else if (c == '"') {
            inQuotes = !inQuotes;
        } else if (c == ',' && !inQuotes) {
            fields.emplace_back();
        } else if (c == '\n' && !inQuotes) {
            ++position;
            break;
        } else if (c != '\r') {
            fields.back() += c;
        }
    }
    return fields;
}

auto key(const Measurement& m) { return std::tie(m.table, m.scene, m.setting, m.frame, m.truth, m.arithmetic); }

std::string cell(const Measurement& m)
{
    if (m.invalid >= 1)
        return "all NaN";
    const std::string degrees = fmt::format("{:.3g} / {:.3g} / {:.3g}", m.mean, m.percentile95, m.maximum);
    return m.invalid > 0 ? fmt::format("{}, NaN {:.1f} %", degrees, 100 * m.invalid) : degrees;
}

// Distinct values of one member of the rows, in order of appearance.
std::vector<std::string> distinct(const std::vector<const Measurement*>& rows, std::string Measurement::*member)
{
    std::vector<std::string> values;
    for (const Measurement* m : rows)
        if (std::find(values.begin(), values.end(), m->*member) == values.end())
            values.push_back(m->*member);
    return values;
}

// A Markdown table with a row per frame and a column per setting.
std::string block(const std::vector<const Measurement*>& rows, const std::vector<std::string>& settings)
{
    std::string text = "| frame |", rule = "| --- |";
    for (const std::string& setting : settings) {
        text += fmt::format(" {} |", setting);
        rule += " --- |";
    }
    text += "\n" + rule + "\n";
    for (const std::string& frame : distinct(rows, &Measurement::frame)) {
        std::string line = fmt::format("| {} |", frame);
        for (const std::string& setting : settings) {
            const auto found = std::find_if(rows.begin(), rows.end(), [&](const Measurement* m) {
                return m->frame == frame && m->setting == setting;
            });
            line += fmt::format(" {} |", found == rows.end() ? "" : cell(**found));
        }
        text += line + "\n";
    }
    return text;
}

// Degrees by which rounding may differ between compilers and machines.
double slack(const std::string& arithmetic)
{
    return arithmetic == "double" ? 1e-9 : arithmetic == "float" ? 1e-5 : arithmetic == "half" ? 1e-3 : 0.02;
}

} // namespace

std::string toCsv(const std::vector<Measurement>& rows)
{
    std::string text = std::string(kHeader) + "\n";
    for (const Measurement& m : rows)
        text += fmt::format("{},{},{},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g}\n", quoted(m.table), quoted(m.scene),
                            quoted(m.setting), quoted(m.frame), quoted(m.truth), quoted(m.arithmetic), m.samples,
                            m.mean, m.percentile95, m.maximum, m.invalid);
    return text;
}

Result<std::vector<Measurement>> measurementsFromCsv(std::string_view text, const std::string& name)
{
    std::vector<Measurement> rows;
    std::size_t position = 0, line = 1;
    const std::size_t headerEnd = std::min(text.find('\n'), text.size());
    if (text.substr(0, headerEnd) != kHeader)
        return inputError(fmt::format("{}: line 1: expected the columns '{}'", name, kHeader));
    position = std::min(headerEnd + 1, text.size());
    while (position < text.size()) {
        ++line;
        std::vector<std::string> f = readLine(text, position);
        if (f.size() != kFields)
            return inputError(fmt::format("{}: line {}: expected {} fields; found {}", name, line, kFields, f.size()));
        Measurement m{f[0], f[1], f[2], f[3], f[4], f[5]};
        if (!parseNumber(f[6], m.samples) || !parseNumber(f[7], m.mean) || !parseNumber(f[8], m.percentile95)
            || !parseNumber(f[9], m.maximum) || !parseNumber(f[10], m.invalid))
            return inputError(fmt::format("{}: line {}: expected numbers in columns 7 to 11", name, line));
        rows.push_back(std::move(m));
    }
    return rows;
}

Result<std::vector<Measurement>> readMeasurements(const std::filesystem::path& file)
{
    const auto text = readText(file);
    return text ? measurementsFromCsv(*text, file.string()) : text.error();
}

Json toJson(const std::vector<Measurement>& rows)
{
    auto list = Json::array();
    for (const Measurement& m : rows) {
        const bool any = m.samples > 0 && m.invalid < 1; // whether any result is finite
        const auto figure = [&](double degrees) { return any ? Json(degrees) : Json(); };
        list.push_back({{"table", m.table},
                        {"scene", m.scene},
                        {"setting", m.setting},
                        {"frame", m.frame},
                        {"truth", m.truth},
                        {"arithmetic", m.arithmetic},
                        {"samples", m.samples},
                        {"mean", figure(m.mean)},
                        {"percentile95", figure(m.percentile95)},
                        {"maximum", figure(m.maximum)},
                        {"invalid", m.invalid}});
    }
    return list;
}

std::string toText(const std::vector<Measurement>& rows)
{
    constexpr std::size_t kColumns = 6; // settings side by side
    std::string text, heading;
    std::vector<std::tuple<std::string, std::string, std::string, std::string>> order;
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<const Measurement*>> groups;
    for (const Measurement& m : rows) {
        auto& group = groups[{m.table, m.scene, m.truth, m.arithmetic}];
        if (group.empty())
            order.emplace_back(m.table, m.scene, m.truth, m.arithmetic);
        group.push_back(&m);
    }
    for (const auto& k : order) {
        const auto& [table, scene, truth, arithmetic] = k;
        if (table != heading)
            text += fmt::format("## {}\n\n", heading = table);
        text += fmt::format("**{}**, against {}, {}: mean / 95 % / max degrees\n\n", scene,
                            truth == "S" || truth == "E" ? "truth " + truth : truth, arithmetic);
        const auto settings = distinct(groups[k], &Measurement::setting);
        for (std::size_t i = 0; i < settings.size(); i += kColumns) {
            const auto last = settings.begin() + std::ptrdiff_t(std::min(i + kColumns, settings.size()));
            text += block(groups[k], {settings.begin() + std::ptrdiff_t(i), last}) + "\n";
        }
    }
    return text;
}

std::vector<Worsening> worsenings(const std::vector<Measurement>& before, const std::vector<Measurement>& now,
                                  std::size_t& compared)
{
    std::vector<const Measurement*> old;
    for (const Measurement& m : before)
        old.push_back(&m);
    const auto less = [](const Measurement* a, const Measurement* b) { return key(*a) < key(*b); };
    std::sort(old.begin(), old.end(), less);
    std::vector<Worsening> list;
    compared = 0;
    for (const Measurement& m : now) {
        const auto found = std::lower_bound(old.begin(), old.end(), &m, less);
        if (found == old.end() || key(**found) != key(m))
            continue;
        ++compared;
        const Measurement& was = **found;
        const double rounding = slack(m.arithmetic);
        const double factor = rounding < 0.01 ? 1.02 : 1.1;
        if (m.mean > was.mean * factor + rounding)
            list.push_back({was, m, fmt::format("mean {:.4g} -> {:.4g}", was.mean, m.mean)});
        else if (m.invalid > was.invalid + 0.002)
            list.push_back({was, m, fmt::format("not finite {:.4g} -> {:.4g}", was.invalid, m.invalid)});
    }
    return list;
}

} // namespace cotan
