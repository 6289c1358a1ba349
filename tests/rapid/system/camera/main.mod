! RAPID Instructions, CamGetResult: a camera finds what the station's tables give, picture by picture.
MODULE camera
  VAR cameradev eye;

  PROC main()
    VAR cameratarget seen;
    VAR num scene;
    VAR clock watch;
    CamSetProgramMode cam1;
    CamLoadJob cam1,"parts.job";
    TPWrite CamGetLoadedJob(cam1);          ! -> parts.job
    CamReqImage cam1;
    CamSetRunMode cam1;
    CamLoadJob cam1,"others.job";
    ClkStart watch;
    CamReqImage cam1\SceneId:=scene;
    TPWrite ValToStr(CamNumberOfResults(cam1)); ! -> 0
    CamGetResult cam1,seen\SceneId:=scene\MaxTime:=1;
    TPWrite seen.name+ValToStr(seen.cframe.trans); ! -> part[120,30,0]
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 0.3
    AliasCamera cam1,eye;
    TPWrite ValToStr(CamNumberOfResults(eye))+CamGetName(eye); ! -> 1cam1
    CamFlush eye;
    CamGetResult eye,seen;
    CamReqImage eye;
    CamGetResult eye,seen\MaxTime:=0.1;
    TPWrite seen.name;                      ! -> part
  ERROR
    TPWrite error_name(ERRNO);              ! -> no run mode ! -> no program mode ! -> no more ! -> time
    TRYNEXT;
  ENDPROC

  FUNC string error_name(errnum number)
    TEST number
    CASE ERR_CAM_NO_RUNMODE:
      RETURN "no run mode";
    CASE ERR_CAM_NO_PROGMODE:
      RETURN "no program mode";
    CASE ERR_CAM_NO_MORE_DATA:
      RETURN "no more";
    CASE ERR_CAM_MAXTIME:
      RETURN "time";
    DEFAULT:
      RETURN "another";
    ENDTEST
  ENDFUNC
ENDMODULE
