#include "syntax.hpp"

#include <algorithm>
#include <iterator>
#include <set>

namespace cotan::shader_text {

namespace {

using Kind = Expression::Kind;

bool isNumber(const Expression& e, const char* text) { return e.kind == Kind::number && e.text == text; }
bool isBoolean(const Expression& e, bool value) { return e.kind == Kind::name && e.text == (value ? "true" : "false"); }

bool isMinusOne(const Expression& e)
{
    return e.kind == Kind::unary && e.text == "-" && isNumber(e.children[0], "1.0");
}

// Simplifies an expression by one step, children first.
void fold(Expression& e)
{
    for (Expression& child : e.children)
        fold(child);
    if (e.kind == Kind::paren && e.children[0].kind != Kind::binary && e.children[0].kind != Kind::select) {
        e = Expression(std::move(e.children[0]));
    } else if (e.kind == Kind::binary && e.text == "==" && e.children[0].kind == Kind::number
               && e.children[1].kind == Kind::number) {
        e = {Kind::name, e.children[0].text == e.children[1].text ? "true" : "false", {}};
    } else if (e.kind == Kind::select && (isBoolean(e.children[0], true) || isBoolean(e.children[0], false))) {
        e = Expression(std::move(e.children[isBoolean(e.children[0], true) ? 1 : 2]));
    } else if (e.kind == Kind::binary && e.text == "*" && isNumber(e.children[1], "1.0")) {
        e = Expression(std::move(e.children[0]));
    } else if (e.kind == Kind::binary && e.text == "*" && isMinusOne(e.children[1])) {
        Expression left = std::move(e.children[0]);
        e = {Kind::unary, "-", {std::move(left)}};
    }
}

bool reads(const Expression& e, const std::string& variable)
{
    bool found = false;
    visitAll(e, [&](const Expression& x) { found |= x.kind == Kind::name && x.text == variable; });
    return found;
}

bool reads(std::span<const Statement> body, const std::string& variable)
{
    bool found = false;
    visitBody(body, [&](const Expression& x) { found |= x.kind == Kind::name && x.text == variable; });
    return found;
}

void decideBranches(std::vector<Statement>& body)
{
    std::vector<Statement> left;
    for (Statement& s : body) {
        if (s.hasValue)
            fold(s.value);
        decideBranches(s.body);
        if (s.kind != Statement::Kind::branch || !(isBoolean(s.value, true) || isBoolean(s.value, false)))
            left.push_back(std::move(s));
        else if (isBoolean(s.value, true))
            std::move(s.body.begin(), s.body.end(), std::back_inserter(left));
    }
    body = std::move(left);
}

bool isAssignmentTo(const Statement& s, const std::string& name)
{
    return s.kind == Statement::Kind::assign && s.target.kind == Kind::name && s.target.text == name
        && !reads(s.value, name);
}

} // namespace

void bindArgument(Module& module, const std::string& function, const std::string& name, const std::string& field,
                  const std::string& value)
{
    Expression constant{Kind::number, value, {}};
    if (value[0] == '-')
        constant = {Kind::unary, "-", {{Kind::number, value.substr(1), {}}}};
    std::size_t position = 0;
    for (Function& f : module.functions)
        if (f.name == function) {
            visitBody(f.body, [&](Expression& e) {
                const bool whole = field.empty() && e.kind == Kind::name && e.text == name;
                const bool part = !field.empty() && e.kind == Kind::member && e.text == field
                    && e.children[0].kind == Kind::name && e.children[0].text == name;
                if (whole || part)
                    e = constant;
            });
            if (!field.empty())
                return;
            while (f.parameters[position].name != name)
                ++position;
            f.parameters.erase(f.parameters.begin() + static_cast<std::ptrdiff_t>(position));
        }
    for (Function& f : module.functions)
        visitBody(f.body, [&](Expression& e) {
            if (e.kind == Kind::call && e.text == function)
                e.children.erase(e.children.begin() + static_cast<std::ptrdiff_t>(position));
        });
}

void simplify(Function& function)
{
    std::vector<Statement>& body = function.body;
    decideBranches(body);
    for (std::size_t i = 0; i + 1 < body.size();)
        if (body[i].kind == Statement::Kind::declare && isAssignmentTo(body[i + 1], body[i].name)) {
            body[i].value = std::move(body[i + 1].value);
            body[i].hasValue = true;
            body.erase(body.begin() + static_cast<std::ptrdiff_t>(i + 1));
        } else {
            ++i;
        }
    for (std::size_t i = body.size(); i-- > 0;) {
        if (body[i].kind == Statement::Kind::declare && !reads(std::span(body).subspan(i + 1), body[i].name))
            body.erase(body.begin() + static_cast<std::ptrdiff_t>(i));
    }
    // Replaces a variable that only the next declaration reads, unchanged, by that declaration.
    for (std::size_t i = 0; i + 1 < body.size(); ++i) {
        const std::span<const Statement> statements(body);
        const Statement& next = body[i + 1];
        if (body[i].kind == Statement::Kind::declare && next.kind == Statement::Kind::declare
            && next.value.kind == Kind::name && next.value.text == body[i].name
            && !reads(statements.subspan(i + 2), body[i].name)) {
            body[i + 1].value = std::move(body[i].value);
            body.erase(body.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

Module neededBy(const Module& module, const std::vector<std::string>& roots)
{
    std::set<std::string> wanted(roots.begin(), roots.end());
    // Uses follow definitions, so one backward pass finds everything.
    for (auto function = module.functions.rbegin(); function != module.functions.rend(); ++function) {
        const Function& f = *function;
        if (!wanted.contains(f.name))
            continue;
        wanted.insert(f.type);
        for (const Variable& p : f.parameters)
            wanted.insert(p.type);
        for (const Statement& s : f.body)
            wanted.insert(s.type);
        visitBody(f.body, [&](const Expression& e) {
            if (e.kind == Kind::call)
                wanted.insert(e.text);
        });
    }
    Module needed;
    const auto isWanted = [&](const auto& one) { return wanted.contains(one.name); };
    std::copy_if(module.structs.begin(), module.structs.end(), std::back_inserter(needed.structs), isWanted);
    std::copy_if(module.functions.begin(), module.functions.end(), std::back_inserter(needed.functions), isWanted);
    return needed;
}

} // namespace cotan::shader_text
