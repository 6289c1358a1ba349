! RAPID Instructions, CamReqImage: jobs, modes and results of a camera, and their errors.
MODULE camera_jobs
  VAR cameratarget found;

  PROC main()
    VAR num n;
    VAR string s;
    CamSetProgramMode cam1;
    TPWrite CamGetLoadedJob(cam1);          ! ->
    CamReqImage cam1;
    CamLoadJob cam1,"parts.job";
    TPWrite CamGetLoadedJob(cam1);          ! -> parts.job
    CamSetRunMode cam1;
    CamReqImage cam1;
    CamGetResult cam1,found;
    TPWrite ValToStr(found.cframe.trans);   ! -> [10,20,0]
    TPWrite ValToStr(CamNumberOfResults(cam1)); ! -> 0
    CamGetResult cam1,found\MaxTime:=1;
    CamLoadJob cam1,"other.job";
    TPWrite CamGetName(cam1);               ! -> cam1
    CamFlush cam1;
    CamSetProgramMode cam1;
    CamStartLoadJob cam1,"other.job";
    CamWaitLoadJob cam1;
    TPWrite CamGetLoadedJob(cam1);          ! -> other.job
    TPWrite "end";                          ! -> end
  ERROR
    TEST ERRNO
    CASE ERR_CAM_NO_MORE_DATA:
      TPWrite "no more";                    ! -> no more
    CASE ERR_CAM_MAXTIME:
      TPWrite "time";
    CASE ERR_CAM_NO_PROGMODE:
      TPWrite "not in program mode";        ! -> not in program mode
    CASE ERR_CAM_NO_RUNMODE:
      TPWrite "not in run mode";            ! -> not in run mode
    CASE ERR_CAM_BUSY:
      TPWrite "busy";
    DEFAULT:
      TPWrite "other";
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
