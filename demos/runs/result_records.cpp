#include "demos/runs/result_records.h"

#include "demos/runs/table.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ode_predictive_space::worlds
{
namespace
{
std::string cell(const nlohmann::json &record, const std::string &field)
{
    if (!record.contains(field))
        return "-";
    const nlohmann::json &value = record.at(field);
    if (value.is_number_float())
        return fixed(value, 2);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

void check(const std::ofstream &out, const std::string &file)
{
    if (!out)
        throw std::runtime_error(file + " cannot be written: " + std::strerror(errno ? errno : EIO));
}
} // namespace

void print_records(std::ostream &out, const nlohmann::json &records, const std::vector<std::string> &fields)
{
    std::vector<std::vector<std::string>> rows{fields};
    for (const nlohmann::json &record : records)
    {
        rows.emplace_back();
        for (const std::string &field : fields)
            rows.back().push_back(cell(record, field));
    }
    print_table(out, rows);
}

void check_writable(const std::string &file)
{
    const bool existed = std::filesystem::exists(file);
    errno = 0;
    check(std::ofstream(file, std::ios::app), file);
    if (!existed)
        std::filesystem::remove(file);
}

void write_json(const std::string &file, const nlohmann::json &value)
{
    errno = 0;
    std::ofstream out(file);
    out << value.dump(2) << '\n';
    out.close();
    check(out, file);
}
} // namespace ode_predictive_space::worlds
