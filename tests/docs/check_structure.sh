#!/usr/bin/env bash
# What keeps one thing in one place: results are values, tables are made of them and never read back.
#   check_structure.sh SOURCE
set -euo pipefail
cd "$1"
failed=0
# WHAT, then grep's options and paths; a hit is a failure.
none() {
    local what=$1 hits
    shift
    if hits=$(grep -rnE --include='*.cpp' --include='*.hpp' "$@"); then
        echo "$what:"
        cut -c1-160 <<<"$hits"
        failed=1
    fi
}
# The renderers of src/pages/report know two columns by their keys, polarity and verdict; nobody else looks one up.
shown=$(ls -d src/pages/*/ | grep -v '/report/')
none "a column is looked up by its key" '(\.|->)key [!=]= ' $shown src/cli src/python
none "a cell of a table is overwritten or read by its place" 'rows\[[^]]*\]\[|rows\.(front|back)\(\)\[' $shown src/cli src/python src/analysis
none "a number is read from a table" 'get_if<double>\(&row|get<double>\(row|get<std::int64_t>\(row' $shown src/cli src/python src/analysis
none "an answer has a JSON object beside it" '_json\(const (ScreenReportInput|AccuracyReportInput|FragilityView|Assessment|ModesResult|Explained|Ablations)' src
none "a sabotage is a branch of the product" 'enum class Defect|namespace [a-z:]*::test ' src sliding fe2d records
none "a solver writes a sentence of its result: a kind of src/core/status.hpp says it" '(notes|warnings|messages?|status_text)(\.push_back\(|\.emplace_back\(| \+?= )\{?(fmt::format\(|std::string\(|")' sliding fe2d
none "a result of a solver holds a sentence" 'std::string (message|note|sentence|warning|status_text|why_not)[a-z_]*(;| =)|std::vector<std::string> (notes|warnings|messages)|std::string text\(\) const' sliding fe2d
none "a solver makes a table" '"core/csv\.hpp"' sliding fe2d
none "solvers include pages or tables of an answer" '#include "(pages|cli)/' sliding fe2d records src/analysis
exit $failed
