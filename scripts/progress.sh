# For scripts/prepare, which sources it: what it says on standard error, and how far a long command is.
# Only bash is used: a new machine has nothing else.
# shellcheck shell=bash

say() {
  clear_line
  printf '%s\n' "$*" >&2
}

# progress TEXT: on a terminal one line that is rewritten, otherwise a line every 15 seconds, so that logs stay short.
progress_due=0
progress_open=
progress() {
  if [ -t 2 ]; then
    printf '\r\033[K%s' "$1" >&2
    progress_open=yes
  elif [ "$SECONDS" -ge "$progress_due" ]; then
    printf '%s\n' "$1" >&2
    progress_due=$((SECONDS + 15))
  fi
}
clear_line() {
  [ -z "$progress_open" ] || printf '\r\033[K' >&2
  progress_open=
}

# follow_install: reads what apt-get prints.
follow_install() {
  local line began=$SECONDS total=0 fetched=0 unpacked=0 ready=0
  while IFS= read -r line; do
    case $line in
      *" newly installed, "*)
        total=${line%% newly*}
        total=${total##* }
        ;;
      "Waiting for "*) progress "packages: waiting for another installation" ;;
      Get:*) progress "packages [$((fetched += 1))/$total] downloading" ;;
      Unpacking\ *) progress "packages [$((unpacked += 1))/$total] unpacking" ;;
      "Setting up "*) progress "packages [$((ready += 1))/$total] setting up" ;;
    esac
  done
  [ "$ready" -eq 0 ] || say "packages: $ready installed in $((SECONDS - began)) s"
}

# milliseconds VARIABLE: of the clock.
milliseconds() { printf -v "$1" '%d' $((${EPOCHREALTIME/[.,]/} / 1000)); }

# What a step takes, in milliseconds: what it took last time (.ninja_log), else a guess, which only has to be fair
# between steps. Sets `weight`.
declare -A last_time=()
read_last_times() { # LOG
  local begin end _ output
  last_time=()
  [ -r "$1" ] || return 0
  while read -r begin end _ output _; do
    [[ $begin == \#* ]] || last_time[$output]=$((end - begin))
  done <"$1"
}
weigh() { # DESCRIPTION, whose last word is the file that the step makes
  weight=${last_time[${1##* }]:-}
  if [ -n "$weight" ]; then
    return
  elif [[ $1 == Building* ]]; then
    weight=10000
  else
    weight=1000
  fi
}

# follow_build LOG PLAN JOBS: reads what ninja prints; LOG has the times of the last build, PLAN is what a dry run
# printed. Shows progress, and all that a failed step says.
follow_build() {
  local line shown='' status='^\[([0-9]+)/([0-9]+)\] (.*)$'
  local weight planned=0 plan_steps=0 done_weight=0 steps=0 left=0 rest now start
  read_last_times "$1"
  while IFS= read -r line; do
    [[ $line =~ $status ]] || continue
    weigh "${BASH_REMATCH[3]}"
    planned=$((planned + weight))
    plan_steps=$((plan_steps + 1))
  done <<<"$2"
  milliseconds start
  while IFS= read -r line; do
    if [[ $line =~ $status ]]; then
      shown=
      steps=${BASH_REMATCH[1]}
      left=$((BASH_REMATCH[2] - steps))
      weigh "${BASH_REMATCH[3]}"
      done_weight=$((done_weight + weight))
      # Steps that turn out not to be needed leave the plan; the rest keeps its mean weight.
      rest=$((planned - done_weight))
      [ "$plan_steps" -le "$steps" ] || rest=$((rest * left / (plan_steps - steps)))
      # The rate so far, after 20 seconds' worth at the rate of the weights.
      milliseconds now
      rest=$((rest * (now - start + 20000) / (done_weight + 20000 * $3)))
      # What ends within two seconds, as a build with nothing to do, needs no words.
      if [ $((now - start)) -lt 2000 ]; then
        continue
      elif [ "$rest" -gt 60000 ]; then
        progress "build ${line%%]*}] about $(((rest + 59999) / 60000)) minutes left"
      else
        progress "build ${line%%]*}] less than a minute left"
      fi
    elif [[ $line == FAILED:* || $line == "ninja: error:"* || -n $shown ]]; then
      shown=yes
      say "$line"
    fi
  done
  milliseconds now
  clear_line
  [ $((now - start)) -lt 2000 ] || say "build: $steps steps in $(((now - start) / 1000)) s"
}
