import { FAULTS_ACCEPTANCE } from './faults_acceptance';
import { FAULTS_ACQUISITION } from './faults_acquisition';
import { FAULTS_BUILD } from './faults_build';
import { FAULTS_CAD } from './faults_cad';
import { FAULTS_CALIBRATE } from './faults_calibrate';
import { FAULTS_CALIBRATION } from './faults_calibration';
import { FAULTS_CAPTURE } from './faults_capture';
import { FAULTS_CORE } from './faults_core';
import { FAULTS_DATASET } from './faults_dataset';
import { FAULTS_DECODE } from './faults_decode';
import { FAULTS_DEVICES } from './faults_devices';
import { FAULTS_DRIVERS } from './faults_drivers';
import { FAULTS_FILES } from './faults_files';
import { FAULTS_FILES_PACKAGES } from './faults_files_packages';
import { FAULTS_FILES_TEXT } from './faults_files_text';
import { FAULTS_FRINGES } from './faults_fringes';
import { FAULTS_INSPECTION } from './faults_inspection';
import { FAULTS_MESH } from './faults_mesh';
import { FAULTS_PARTS } from './faults_parts';
import { FAULTS_PHASE } from './faults_phase';
import { FAULTS_RECONSTRUCT } from './faults_reconstruct';
import { FAULTS_REGISTRATION } from './faults_registration';
import { FAULTS_RIG } from './faults_rig';
import { FAULTS_SERVER } from './faults_server';
import { FAULTS_SERVICE } from './faults_service';
import { FAULTS_SERVICE_COMMANDS } from './faults_service_commands';
import { FAULTS_SERVICE_SURFACE } from './faults_service_surface';
import { FAULTS_SIMULATE } from './faults_simulate';

/** Sentences of the server: the first column is the sentence as the library writes it. */
export const FAULTS = {
  ...FAULTS_ACCEPTANCE,
  ...FAULTS_ACQUISITION,
  ...FAULTS_BUILD,
  ...FAULTS_CAD,
  ...FAULTS_CALIBRATE,
  ...FAULTS_CALIBRATION,
  ...FAULTS_CAPTURE,
  ...FAULTS_CORE,
  ...FAULTS_DATASET,
  ...FAULTS_DECODE,
  ...FAULTS_DEVICES,
  ...FAULTS_DRIVERS,
  ...FAULTS_FILES,
  ...FAULTS_FILES_PACKAGES,
  ...FAULTS_FILES_TEXT,
  ...FAULTS_FRINGES,
  ...FAULTS_INSPECTION,
  ...FAULTS_MESH,
  ...FAULTS_PARTS,
  ...FAULTS_PHASE,
  ...FAULTS_RECONSTRUCT,
  ...FAULTS_REGISTRATION,
  ...FAULTS_RIG,
  ...FAULTS_SERVER,
  ...FAULTS_SERVICE,
  ...FAULTS_SERVICE_COMMANDS,
  ...FAULTS_SERVICE_SURFACE,
  ...FAULTS_SIMULATE,
} as const;
