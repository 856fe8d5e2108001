/* The plugin's settings: what RepRapFirmware needs of OctoPrint, and the printer profile. */
