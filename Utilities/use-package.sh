#!/usr/bin/env bash
# In a clean root, as test-packages.sh calls it: install the package that lies beside this script, use the plugin in
# pvpython, through pvserver and in ParaView's window, and remove the package again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
name=HighOrderParticleIsosurface

files() { find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /package -o -path /var -o -path /root \
  -o -name __pycache__ \) -prune -o -type f -print | sort; }

apt-get -q update
apt-get -q install -y --no-install-recommends paraview python3-paraview xvfb xauth
files >before
apt-get -q install -y --no-install-recommends ./*.deb
files >with

cat >use.py <<EOT
import sys
from paraview.simple import *
if len(sys.argv) > 1:
    Connect("127.0.0.1", int(sys.argv[1]))
    LoadDistributedPlugin("$name", remote=True, ns=globals())
LoadDistributedPlugin("$name", remote=False, ns=globals())
reader = XMLUnstructuredGridReader(FileName=["/package/mfem_hex1_p8.vtu"])
surface = $name(Input=reader, ContourBy=["POINTS", "u"], Isosurfaces=[0.2])
surface.UpdatePipeline()
print("particles:", surface.GetDataInformation().GetNumberOfPoints())
EOT
cat >list.py <<EOT
import os
from paraview import servermanager
plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
names = [plugins.GetPluginName(i) for i in range(plugins.GetNumberOfPlugins())]
open("/package/listed", "w").write("\n".join(names))
os._exit(0)
EOT

echo "== pvpython"
xvfb-run -a pvpython use.py | grep -E '^particles: [1-9]'
echo "== pvserver"
xvfb-run -a -s '-screen 0 1280x1024x24' pvserver --server-port=11199 &
sleep 10
xvfb-run -a pvpython use.py 11199 | grep -E '^particles: [1-9]'
wait
echo "== ParaView's window"
xvfb-run -a -s '-screen 0 1280x1024x24' timeout 120 paraview --dr --script=/package/list.py || true
grep -x "$name" listed

echo "== removed"
apt-get -q purge -y paraview-high-order-particles
files >after
diff before after
[ "$(wc -l <with)" -gt "$(wc -l <before)" ]
