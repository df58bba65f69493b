# A Slurm of its own on this machine: munged, slurmctld and two slurmd on the loopback address, in a
# folder of their own. To be sourced; needs root, since munged and slurmd of another user do not
# trust each other.
#   start_site FOLDER    comes back when both nodes are idle; 1 where they are not within 30 s
#   kill_node n2         the node and all that it runs, at once
#   stop_site

site_programs=(munged slurmctld slurmd sbatch squeue scancel scontrol sinfo)

# What is missing, as a sentence; nothing: all is there.
site_lacks() {
  local program
  export PATH=$PATH:/usr/sbin:/sbin
  for program in "${site_programs[@]}"; do
    command -v "$program" >/dev/null || {
      echo "$program is not installed (tools/packages-ci.txt)"
      return
    }
  done
  [[ $(id -u) == 0 ]] || echo "the test's own Slurm needs root"
}

free_ports() {
  python3 - "$1" <<'P'
import socket, sys
held = [socket.socket() for _ in range(int(sys.argv[1]))]
for one in held:
    one.bind(("127.0.0.1", 0))
print(*[one.getsockname()[1] for one in held])
P
}

write_site() {
  local host ports
  host=$(hostname)
  read -ra ports <<<"$(free_ports 3)"
  mkdir -p "$site"/{state,spool_n1,spool_n2,munge,log}
  chmod 700 "$site/munge"
  head -c 1024 /dev/urandom >"$site/munge/key"
  chmod 400 "$site/munge/key"
  cat >"$site/slurm.conf" <<C
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$site/munge/socket
CredType=cred/munge
StateSaveLocation=$site/state
SlurmdSpoolDir=$site/spool_%n
SlurmctldPidFile=$site/slurmctld.pid
SlurmdPidFile=$site/slurmd_%n.pid
SlurmctldLogFile=$site/log/slurmctld
SlurmdLogFile=$site/log/slurmd_%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SlurmdTimeout=10
KillWait=5
SlurmdParameters=config_overrides
${site_scheduler:+SchedulerParameters=$site_scheduler}
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=1 RealMemory=1000
PartitionName=test Nodes=n1,n2 Default=YES MaxTime=1:00:00 State=UP
C
}

start_site() {
  site=$1
  export SLURM_CONF=$site/slurm.conf
  write_site
  munged --force --key-file="$site/munge/key" --socket="$site/munge/socket" \
    --pid-file="$site/munge/pid" --log-file="$site/log/munged" --seed-file="$site/munge/seed"
  slurmctld -c
  slurmd -N n1
  slurmd -N n2
  local tries
  for ((tries = 0; tries < 60; ++tries)); do
    [[ $(sinfo --noheader --Node --format=%T 2>/dev/null | grep -c idle) == 2 ]] && return 0
    sleep 0.5
  done
  return 1
}

children_of() {
  local child
  for child in $(ps -o pid= --ppid "$1"); do
    echo "$child"
    children_of "$child"
  done
}

# A slurmd's tasks are no children of it: their launchers (slurmstepd) write to the node's log.
launchers_of() {
  local launcher
  for launcher in $(pgrep -u "$(id -u)" slurmstepd); do
    readlink "/proc/$launcher"/fd/* 2>/dev/null | grep -q "^$site/log/slurmd_$1\$" && echo "$launcher"
  done
  return 0
}

kill_node() {
  local launcher
  for launcher in $(launchers_of "$1"); do
    kill -9 "$launcher" $(children_of "$launcher") 2>/dev/null
  done
  kill -9 "$(<"$site/slurmd_$1.pid")"
}

stop_site() {
  local file
  scancel --user=root --quiet 2>/dev/null
  sleep 0.5
  for file in "$site"/slurmd_*.pid "$site/slurmctld.pid" "$site/munge/pid"; do
    [[ -f $file ]] && kill "$(<"$file")" 2>/dev/null
  done
  return 0
}
