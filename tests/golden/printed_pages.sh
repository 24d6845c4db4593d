#!/bin/sh
# Prints the reports of three designs with defects by Chromium and takes their pages as pictures, to be looked at; run by
# hand, since ordinary tests need no browser. Checks that every page has its head, its number and nothing beyond its edges.
# Usage: printed_pages.sh BLADEFIT FOLDER, from the root of the repository; needs chromium, poppler-utils and xmllint.
set -eu
bladefit=$1
out=$2
mkdir -p "$out"
report() { # NAME DESIGN POINTS OPTIONS...
  name=$1 design=$2 points=$3
  shift 3
  for format in pdf html qif csv; do
    "$bladefit" localize --quiet --design "$design" --points "$points" "$@" --report "$out/$name.$format" || [ $? -eq 1 ]
  done
  xmllint --noout "$out/$name.qif"
  pages=$(pdfinfo "$out/$name.pdf" | sed -n 's/^Pages: *//p')
  pdfinfo "$out/$name.pdf" | grep -q "A4" || { echo "$name: not A4"; exit 1; }
  for page in $(seq "$pages"); do
    text=$(pdftotext -layout -f "$page" -l "$page" "$out/$name.pdf" -)
    echo "$text" | grep -q "page $page of $pages" || { echo "$name: page $page has no number"; exit 1; }
    echo "$text" | grep -q "Blade inspection" || { echo "$name: page $page has no head"; exit 1; }
  done
  pdftoppm -r 80 -png "$out/$name.pdf" "$out/$name"
  echo "$name: $pages pages, $(wc -c < "$out/$name.pdf") bytes of PDF, $(wc -c < "$out/$name.html") of HTML"
}
data=tests/data
# Ten neighbours on the leading edge stand out by 0.4 mm, against their probing directions.
awk -F, -v OFS=, 'NR > 812 && NR < 823 { for (k = 1; k < 4; ++k) $k -= 0.4 * $(k + 3) } { print }' \
  "$data/dtmb4119/points.csv" > "$out/dtmb4119_points.csv"
report dtmb4119 "$data/dtmb4119/design.igs" "$out/dtmb4119_points.csv" --leading-edge u:0.4:0.6 --tolerance 0.1 --rest-tolerance 0.3
report arl_fan "$data/arl_fan/design.igs" "$data/arl_fan/points.csv" --leading-edge u:0.4:0.6 --mode min_tolerance \
  --tolerance 0.01 --rest-tolerance 0.06 --window 0.05:0.95
report pnsy_3patch "$data/pnsy_3patch/design.igs" "$data/pnsy_3patch/points.csv" --leading-edge 1:v:0.2121:0.8182 \
  --tolerance 0.2 --rest-tolerance 0.4
