# Untried. The core libraries: nix-build packaging
{ pkgs ? import <nixpkgs> { } }:
pkgs.stdenv.mkDerivation {
  pname = "vericone";
  version = "0.1.0";
  src = ./..;
  nativeBuildInputs = [ pkgs.cmake pkgs.ninja ];
  propagatedBuildInputs = [ pkgs.eigen pkgs.boost ];
  cmakeFlags = [ "-DVERICONE_CORE_ONLY=ON" ];
}
