#!/usr/bin/env bash
# The figures of Weber, Hahmann, Hagen, "Methods for Feature Detection in Point Clouds", made by the program alone, and
# what the method does by itself.
# docs/methods/gauss.md shows them and says what differs from the paper. At the end what other methods see before they
# decide, and what they decide: on the pages of those.
set -euo pipefail

keenline=${1:?usage: scripts/figures.sh KEENLINE FOLDER}
folder=${2:?usage: scripts/figures.sh KEENLINE FOLDER}
points=${KEENLINE_FIGURE_POINTS:-9000}  # fewer: quicker, coarser figures
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# cloud NAME SHAPE [synth options]: a cloud in the work folder
cloud() {
  local name=$1 shape=$2
  shift 2
  "$keenline" synth "$shape" -o "$work/$name.ply" --points "$points" --quiet "$@"
}

# labels NAME CLOUD [detect options]: its labels by the paper's section 4; found: those of a first command
labels() {
  local name=$1 source=$2
  shift 2
  "$keenline" detect "$work/$source.ply" -o "$work/$name.ply" --plain --quiet "$@"
}

found() { "$keenline" detect "$work/$2.ply" -o "$work/$1.ply" --quiet; }

# sheet FIGURE [picture options]: the clouds and captions gathered by add on one sheet
shown=()
add() { shown+=("$work/$1.ply" --caption "$2"); }
sheet() {
  local figure=$1
  shift
  "$keenline" picture "${shown[@]}" -o "$folder/$figure.png" "$@"
  shown=()
}

# Figure 2: the Gauss map of one point, coloured by cluster. Clouds of the same seed are the same everywhere:
# point 1613 lies on an edge of this cube, 1468 at a corner, 4339 in the middle of a face.
"$keenline" synth cube -o "$work/cube.ply" --points 6000 --quiet
"$keenline" synth sphere -o "$work/sphere.ply" --points 6000 --quiet
"$keenline" gaussmap "$work/cube.ply" --plain -o "$folder/figure2-cube.png" --columns 3 --size 360,410 \
  --point 1613 --caption "cube, on an edge" --point 1468 --caption "cube, at a corner" --point 4339 --caption "cube, on a face"
"$keenline" gaussmap "$work/sphere.ply" --plain -o "$folder/figure2-sphere.png" --size 360,410 --point 0 --caption "sphere"

# Figure 4: the sensitivity sigma.
for shape in fandisk icosahedron; do
  cloud "$shape" "$shape"
  for sigma in 2.5 5 10 20 30 45; do
    labels "$shape-$sigma" "$shape" --sigma "$sigma" --max-clusters 5
    add "$shape-$sigma" "$shape, sigma $sigma deg"
  done
  sheet "figure4-$shape" --columns 3 --size 370,270
done

# Figure 5: noise, as the paper words it (of the bounding box) and in units of the spacing h.
for unit in bbox h; do
  for percent in 5 10 15; do
    name=noise-$percent$unit
    cloud "$name" cube --noise "$(printf '0.%02d' "$percent")$unit"
    labels "$name-labels" "$name"
    case $unit in
      bbox) add "$name-labels" "noise $percent % of the bounding box" ;;
      h) add "$name-labels" "noise $percent % of the spacing" ;;
    esac
  done
  case $unit in
    bbox) sheet figure5-bounding-box --columns 3 --size 370,270 ;;
    h) sheet figure5-spacing --columns 3 --size 370,270 ;;
  esac
done

# Figure 6: the gallery.
for shape in cube icosahedron trim-star fandisk vase; do
  cloud "gallery-$shape" "$shape"
  labels "gallery-$shape-labels" "gallery-$shape" --max-clusters 5
  add "gallery-$shape-labels" "$shape"
done
sheet figure6 --columns 3 --size 370,300

# No options at all: random points, points on the edges as well, noise.
for shape in cube fandisk; do
  cloud "default-$shape-random" "$shape"
  cloud "default-$shape-mesh" "$shape" --sampling mesh
  cloud "default-$shape-noise" "$shape" --noise 0.1h
  for kind in random mesh noise; do found "default-$shape-$kind-labels" "default-$shape-$kind"; done
  add "default-$shape-random-labels" "$shape, random points"
  add "default-$shape-mesh-labels" "$shape, points on edges too"
  add "default-$shape-noise-labels" "$shape, noise 10 % of the spacing"
done
sheet default --columns 3 --size 370,300

# Demarsin and tensor voting: the score that each decides by, and the labels.
for method in demarsin tensor_voting; do
  name=${method//_/-}
  for shape in cube fandisk icosahedron; do
    cloud "$name-$shape" "$shape"
    "$keenline" detect "$work/$name-$shape.ply" -o "$work/$name-$shape-labels.ply" --method "$method" --quiet
    add "$name-$shape-labels" "$shape"
  done
  again=("${shown[@]}")
  sheet "$name-score" --color score --columns 3 --size 370,270
  shown=("${again[@]}")
  sheet "$name" --columns 3 --size 370,270
done

# The stages of the methods pauly and gumhold: what every point says, and what becomes of it.
# method NAME CLOUD METHOD [detect options]: its labels by another method
method() { "$keenline" detect "$work/$2.ply" -o "$work/$1.ply" --method "$3" --quiet "${@:4}"; }
for name in pauly gumhold; do
  method "$name" default-fandisk-random "$name"
  method "$name-plain" default-fandisk-random "$name" --plain
  method "$name-noise" default-fandisk-noise "$name"
  add "$name" "score"
  sheet "$name-score" --color score --size 555,400
  add "$name" "edges and corners"
  add "$name-plain" "with --plain"
  add "$name-noise" "noise 10 % of the spacing"
  sheet "$name-kinds" --columns 3 --size 370,300
done

# The last stage of the published methods: each one's own lines from its own labels, as traced and moved onto the design line.
for name in gumhold pauly demarsin tensor_voting; do
  for step in no-snap snap; do
    lines=$work/$name-$step.json
    "$keenline" lines "$work/default-fandisk-random.ply" -o "$lines" --method "$name" --trace "$name" "--$step" --quiet
    shown+=("$work/default-fandisk-random.ply" --lines "$lines" --caption "$([ $step = snap ] && echo snapped || echo "as traced")")
  done
  sheet "${name//_/-}-lines" --columns 2 --size 555,400
done
