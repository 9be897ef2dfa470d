#!/bin/bash
# examples/farm/plan_queue.py on a Slurm cluster: what is listed, rendered in parts, refined and converted as
# steps that wait for each other is the video of all subframes; and a step that failed is taken up again.
source "$(dirname "$0")/slurm_cluster.sh"
farm=$WEFT_SOURCE/examples/farm
looks=(--raster 96x64@30i,tff --frames 1-2 --subframe-rate 480 --aperture box)
weft trace "$WEFT_SOURCE/examples/scenes/one_mover.lua" --raster 96x64@30i,tff --oversample 1x1x8 --frames 0-3 \
    -o "made.####.exr" -q || exit 1
weft convert "made.####.exr" --raster 96x64@30i,tff --aperture box --output-frames 1-2 --bits 16 -q -o all.y4m || exit 1

# A renderer: what it is asked for, from what is made already. It fails where there is a file `broken`.
cat >renderer.sh <<END
#!/bin/bash
[ ! -e $work/broken ] || exit 9
echo "\$@" >>$work/rendered
printf -v file $work/made.%04d.exr "\$1"
cp "\$file" "\$9"
END
chmod +x renderer.sh
within 20 idle || exit 1

touch broken
jobs=$("$farm/plan_queue.py" slurm 2 1 planned out.y4m "$work/renderer.sh" "${looks[@]}")
check "queued: list, render, convert" same "$(wc -w <<<"$jobs")" 3
check "it ends" within 60 over
check "nothing is there" same "$(ls planned/*.exr out.y4m 2>/dev/null)" ""
rm broken
jobs=$("$farm/plan_queue.py" slurm 2 1 planned out.y4m "$work/renderer.sh" "${looks[@]}")
check "again" within 60 over
check "16 subframes" same "$(ls planned/*.exr | wc -l)" 16
weft convert planned --raster 96x64@30i,tff --subframe-rate 480 --aperture box --output-frames 1-2 -q -o own.y4m
weft convert "made.####.exr" --raster 96x64@30i,tff --aperture box --output-frames 1-2 -q -o whole.y4m
check "the video is that of all subframes" cmp out.y4m whole.y4m
check "and by hand" cmp own.y4m whole.y4m

rm rendered
jobs=$("$farm/plan_queue.py" slurm 2 4 refined refined.y4m "$work/renderer.sh" "${looks[@]}" --error 0.005)
check "refining" within 120 over
check "rectangles were rendered" grep -qv " 0 0 96 64 " rendered
check "nothing is wanted" exits 0 weft plan "${looks[@]}" --error 0.005 --refine refined --format json
check "any more" value "d['subframes'] == []"
check "the video is there" exits 0 weft measure refined.y4m --against whole.y4m --json
check "and as good" value "d['difference']['rmse'] < 0.0005"
[ $failed = 0 ] || tail -n 20 slurm-*.out log/*

finish
