#include "cost/cards.hpp"

#include <algorithm>

#include "compile.hpp"
#include "core/parse_number.hpp"

namespace cotan::cost {

namespace {

constexpr std::string_view kHeader = "maker,card,device,driver,date,stage,row,instructions,arithmetic,registers,code "
                                     "bytes,inverse throughput,latency,failure";
constexpr std::size_t kColumns = 14, kFirstNumber = 7, kFailure = 13;

// The numbers of a stage, in column order.
constexpr std::optional<double> StageCode::*kNumbers[] = {&StageCode::instructions,      &StageCode::arithmetic,
                                                          &StageCode::registers,         &StageCode::bytes,
                                                          &StageCode::inverseThroughput, &StageCode::latency};

std::string cellOf(std::string_view text)
{
    if (text.find_first_of(",\"") == std::string_view::npos)
        return std::string(text);
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

std::vector<std::string> cellsOf(std::string_view line)
{
    std::vector<std::string> cells(1);
    bool inQuotes = false;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == '"' && inQuotes && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[i++];
        else if (line[i] == '"')
            inQuotes = !inQuotes;
        else if (line[i] == ',' && !inQuotes)
            cells.emplace_back();
        else
            cells.back() += line[i];
    return cells;
}

// Returns false if the cell is neither empty nor a finite number >= 0.
bool readNumber(const std::string& cell, std::optional<double>& number)
{
    if (cell.empty())
        return true;
    double value = 0;
    const bool read = parseNumber(cell, value);
    number = value;
    return read && value >= 0 && value < 1e15;
}

StageCode* findStage(DeviceCode& gpu, std::string_view stage, std::string_view row)
{
    StageCode* found = nullptr;
    eachStage(gpu, [&](std::string_view kind, std::string_view name, StageCode& code) {
        if (!found && stage == kind && row == name)
            found = &code;
    });
    return found;
}

} // namespace

std::string gpusToCsv(const std::vector<DeviceCode>& gpus)
{
    std::string text = std::string(kHeader) + '\n';
    for (const DeviceCode& gpu : gpus) {
        const std::string head = cellOf(gpu.maker) + ',' + cellOf(gpu.family.empty() ? gpu.name : gpu.family) + ','
            + cellOf(gpu.name) + ',' + cellOf(gpu.driver) + ',' + gpu.date + ',';
        const auto line = [&](std::string_view stage, std::string_view row, const StageCode& code) {
            text += head + std::string(stage) + ',' + cellOf(row);
            for (const auto number : kNumbers) {
                text += ',';
                char digits[32];
                if (code.*number)
                    text.append(digits, std::to_chars(digits, digits + sizeof digits, *(code.*number)).ptr);
            }
            text += ',' + cellOf(code.failure) + '\n';
        };
        if (!gpu.silence.empty()) {
            StageCode none;
            none.failure = gpu.silence;
            line("silence", "", none);
            continue;
        }
        eachStage(gpu, line);
    }
    return text;
}

Result<std::vector<DeviceCode>> gpusFromCsv(std::string_view text)
{
    std::vector<const Row*> all;
    for (const Row& row : rows())
        all.push_back(&row);
    std::vector<DeviceCode> gpus;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.ends_with('\r'))
            line.remove_suffix(1);
        const std::string where = "line " + std::to_string(++number) + ": ";
        if (line == kHeader)
            continue;
        if (number == 1)
            return inputError(where + "expected '" + std::string(kHeader) + "'");
        const std::vector<std::string> cells = cellsOf(line);
        if (cells.size() != kColumns)
            return inputError(where + "expected " + std::to_string(kColumns) + " cells, found "
                              + std::to_string(cells.size()));
        if (gpus.empty() || gpus.back().family != cells[1] || gpus.back().maker != cells[0]) {
            gpus.push_back({cells[2], cells[0], cells[3], cells[1], "", cells[4], {}, {}, {}});
            prepareStages(gpus.back(), all);
        }
        if (cells[5] == "silence")
            gpus.back().silence = cells[kFailure];
        StageCode unknown;
        StageCode* stage = findStage(gpus.back(), cells[5], cells[6]);
        StageCode& code = stage ? *stage : unknown;
        code.failure = cells[kFailure];
        for (std::size_t i = 0; i < std::size(kNumbers); ++i)
            if (!readNumber(cells[kFirstNumber + i], code.*kNumbers[i]))
                return inputError(where + "expected a number, found '" + cells[kFirstNumber + i] + "'");
    }
    return gpus;
}

} // namespace cotan::cost
