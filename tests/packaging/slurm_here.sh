# shellcheck shell=bash
# Slurm on this machine alone, in a folder of its own, for tests: sourced by cluster_test.sh.
# start_slurm FOLDER: starts munged, slurmctld and slurmd and sets SLURM_CONF; explains on stderr why
# that is not possible. stop_slurm ends them.

slurm_pids=()

start_slurm() {
    local folder=$1 name cores program
    for program in munged mungekey slurmctld slurmd sbatch squeue; do
        if ! command -v "$program" >/dev/null; then
            echo "$program is not installed" >&2
            return 1
        fi
    done
    if [ "$(id -u)" -ne 0 ]; then
        echo "slurmd runs as root only" >&2
        return 1
    fi
    name=$(hostname -s)
    cores=$(nproc)
    mkdir -p "$folder"/{munge,state,spool}
    chmod 711 "$folder" "$folder/munge"
    mungekey --create --keyfile="$folder/munge/key"
    munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
        --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" \
        --seed-file="$folder/munge/seed" >"$folder/munge/out" 2>&1 &
    slurm_pids+=($!)
    cat >"$folder/slurm.conf" <<CONF
ClusterName=marsview
SlurmctldHost=$name(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmctldPort=$((20000 + $$ % 10000))
SlurmdPort=$((30000 + $$ % 10000))
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=100000
MinJobAge=600
JobCompType=jobcomp/none
AccountingStorageType=accounting_storage/none
NodeName=$name NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=$name Default=YES MaxTime=INFINITE State=UP
CONF
    export SLURM_CONF=$folder/slurm.conf
    slurmctld -D -c >"$folder/slurmctld.out" 2>&1 &
    slurm_pids+=($!)
    slurmd -D -c >"$folder/slurmd.out" 2>&1 &
    slurm_pids+=($!)
    local tries=0
    until sinfo --noheader --format=%T 2>/dev/null | grep -q -E 'idle|mixed|allocated'; do
        tries=$((tries + 1))
        if [ $tries -gt 300 ]; then
            echo "Slurm does not start here; its last messages:" >&2
            tail -n 3 "$folder"/*.log "$folder"/*.out "$folder"/munge/out >&2
            return 1
        fi
        sleep 0.1
    done
}

stop_slurm() {
    local pid
    for pid in "${slurm_pids[@]}"; do
        kill "$pid" 2>/dev/null || true
    done
    wait "${slurm_pids[@]}" 2>/dev/null || true
}
