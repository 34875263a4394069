// A program with one defect (CMakeLists.txt): the named verification case must see it.
//
// exit codes: 0 some check of the case fails (what is wanted), 1 all pass, 2 no such case, 3 the case throws
#include "verification/cases/registry.hpp"

#include <cstdio>
#include <exception>
#include <string>

int main(int argc, char** argv)
{
    const std::string id = argc == 2 ? argv[1] : "";
    for (const damslip::verification::Case& subject : damslip::verification::all_cases()) {
        if (subject.id != id) continue;
        try {
            int failed = 0, all = 0;
            for (const auto& check : subject.run()) {
                ++all;
                if (check.passed()) continue;
                if (++failed <= 5)
                    std::printf("%s: expected %g, computed %g\n", check.quantity.c_str(), check.expected,
                                check.computed);
            }
            std::printf("%s: %d of %d checks see the defect\n", id.c_str(), failed, all);
            return failed > 0 ? 0 : 1;
        } catch (const std::exception& error) {
            std::printf("%s: %s\n", id.c_str(), error.what());
            return 3;
        }
    }
    std::printf("no case \"%s\"\n", id.c_str());
    return 2;
}
