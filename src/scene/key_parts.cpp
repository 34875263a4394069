#include "scene/key_parts.hpp"

namespace damslip::keys {

Key number(std::string name, Units units, Range range, std::string default_text, std::string meaning,
           std::string example, std::function<Slot(void*)> slot)
{
    const bool required = default_text == "required";
    return {std::move(name),    std::move(units), {}, range, required, std::move(default_text), std::move(meaning),
            std::move(example), std::move(slot)};
}

Key word(std::string name, std::string default_text, std::string meaning, std::string example,
         std::function<Slot(void*)> slot)
{
    const bool required = default_text == "required";
    return {std::move(name), {}, {}, {}, required, std::move(default_text), std::move(meaning), std::move(example),
            std::move(slot)};
}

Key pairs(std::string name, Units first, Units second, Range range, std::string default_text, std::string meaning,
          std::string example, std::function<Slot(void*)> slot)
{
    return {std::move(name),         std::move(first),   std::move(second),  range,          false,
            std::move(default_text), std::move(meaning), std::move(example), std::move(slot)};
}

} // namespace damslip::keys
