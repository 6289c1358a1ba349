! RAPID Instructions, CamSetParameter: the parameters of a camera's job have types of their own.
MODULE camera_parameters
  PROC main()
    VAR bool enabled;
    VAR num threshold;
    VAR string label;
    CamGetParameter cam1,"Pattern_1.Tool_Enabled"\BoolVar:=enabled;
    CamSetParameter cam1,"Pattern_1.Threshold"\NumVal:=85;
    CamGetParameter cam1,"Pattern_1.Threshold"\NumVar:=threshold;
    CamGetParameter cam1,"pattern_1.label"\StrVar:=label;
    TPWrite label+ValToStr(enabled)+ValToStr(threshold); ! -> lidTRUE85
    CamSetExposure cam1\ExposureTime:=12.5\Brightness:=40;
    TPWrite ValToStr(CamGetExposure(cam1));         ! -> 12.5
    TPWrite ValToStr(CamGetExposure(cam1\Brightness)); ! -> 40
    CamSetParameter cam1,"Pattern_1.Threshold"\StrVal:="85";
    CamGetParameter cam1,"Pattern_1.Threshold"\BoolVar:=enabled;
    CamGetParameter cam1,"Pattern_2.Threshold"\NumVar:=threshold;
  ERROR
    IF ERRNO=ERR_CAM_SET_MISMATCH TPWrite "not to be set so"; ! -> not to be set so
    IF ERRNO=ERR_CAM_GET_MISMATCH TPWrite "not to be read so";
    ! -> not to be read so
    ! -> not to be read so
    TRYNEXT;
  ENDPROC
ENDMODULE
